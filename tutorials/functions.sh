# Sourced by the Allrun scripts, in the folder of the scene: sets up the
# checkout if need be, takes "entry value" pairs for constant/scene, and
# makes the case ready. From here on the first command that fails ends Allrun
# with its status and a sentence.
#     ./Allrun                the scene as it stands
#     ./Allrun entry value    other values of the entries in constant/scene
#     NP=1 ./Allrun           number of ranks, default 2
tutorials=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd) || exit 1
[ ! -d "$tutorials"/../src ] || "$tutorials"/../bin/setup || exit 1
. "$tutorials"/../bin/env || exit 1
set -eE -o pipefail
trap 'echo "Allrun: stopped by the error above, in $PWD" 1>&2' ERR

stop() { echo "Allrun: $*" 1>&2; exit 1; }

# Numbers of ranks, entries and values are checked before an older run is deleted
NP=${NP:-2}
[[ $NP =~ ^[1-9][0-9]*$ ]] || stop "NP is '$NP', it must be a number of ranks, 1 and greater"
[ $(($# % 2)) -eq 0 ] || stop "'${!#}' has no value: ./Allrun entry value [entry value]..."
for ((i = 1; i < $#; i += 2))
do
    grep -q "^${!i} " constant/scene ||
        stop "constant/scene has no entry '${!i}', but" \
            "$(sed -n 's/^\([A-Za-z0-9]*\) .*/\1/p' constant/scene | tr '\n' ' ')"
done

./Allclean
while [ $# -ge 2 ]
do
    sed -i "s|^$1\( *\)[^;]*;|$1\1$2;|" constant/scene
    shift 2
done

# Values stay in constant/scene for later runs
echo "Scene: $(sed -n 's/^\([A-Za-z0-9]*\) *\([^;]*\);.*/\1 \2/p' constant/scene | paste -sd, | sed 's/,/, /g')"

# Runs a program, its output in log.<program>; one sentence if it fails
run()
{
    echo "Running $* (log.$1)"
    "$@" > "log.$1" 2>&1 || failed "$1"
    warned "$1"
}

# What a log says of its error: OpenFOAM's sentence, or its end
failed()
{
    grep -q "FOAM FATAL" "log.$1" &&
        sed -n '/FOAM FATAL/,/^\(\[0\] *\)\?$/p' "log.$1" | head -n 20 || tail "log.$1"
    stop "$1 failed (log.$1)"
}

# How many warnings a log has, and the first
warned()
{
    local n
    n=$(grep -c "FOAM Warning" "log.$1") || return 0
    echo "    $n warnings (log.$1):" "$(awk '/FOAM Warning/ { found = 1; next }
        found && !/From |in file |Reading "|^ *$/ { print; exit }' "log.$1")"
}

# The solver on NP ranks
solve()
{
    if [ "$NP" -eq 1 ]
    then
        run "$1"
        return
    fi
    sed -i "s/^numberOfSubdomains.*/numberOfSubdomains $NP;/" \
        system/decomposeParDict
    run decomposePar
    echo "Running $1 on $NP ranks (log.$1)"
    mpirun --bind-to none --oversubscribe -np "$NP" "$1" -parallel \
        > "log.$1" 2>&1 || failed "$1"
    warned "$1"
    run reconstructPar
}

# python <script> [arguments]: with numpy, matplotlib and the package deformablebodies
python() { "$DEFORMABLE_BODIES_DIR/bin/python" "$@"; }

# draw bodies <arguments of bin/drawBodies>, draw <script> <picture>: by VTK, which may be
# missing or see no display
draw()
{
    if [ "$1" = bodies ]
    then
        "$DEFORMABLE_BODIES_DIR/bin/drawBodies" "${@:2}"
    else
        python "$@"
    fi || echo "No picture $2: VTK could not draw (install python3-vtk9 and xvfb)"
}

# finished <what else to look at>: the last line; names the pictures that are there
finished()
{
    echo "Done: $(printf '%s, ' results/*.png)$*"
}

cp -r 0.orig 0
run blockMesh
