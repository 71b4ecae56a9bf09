# Sourced by the Allrun scripts, in the folder of the scene: sets up the
# checkout if need be, takes "entry value" pairs for constant/scene, and
# makes the case ready.
#     ./Allrun                the scene as it stands
#     ./Allrun entry value    other values of the entries in constant/scene
#     NP=1 ./Allrun           number of ranks, default 2
scene=$PWD
checkout=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
"$checkout"/bin/setup || exit 1
. "$checkout"/bin/env || exit 1
set -e
NP=${NP:-2}

./Allclean
while [ $# -ge 2 ]
do
    grep -q "^$1 " constant/scene ||
        { echo "constant/scene has no entry $1"; exit 1; }
    sed -i "s/^$1\( *\)[^;]*;/$1\1$2;/" constant/scene
    shift 2
done

# Runs a program, its output in log.<program>; one sentence if it fails
run()
{
    echo "Running $* (log.$1)"
    "$@" > "log.$1" 2>&1 || { tail "log.$1"; echo "$1 failed"; exit 1; }
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
        > "log.$1" 2>&1 || { tail "log.$1"; echo "$1 failed"; exit 1; }
    run reconstructPar
}

# python <script> [arguments]: with numpy and matplotlib
python() { "$DEFORMABLE_BODIES_DIR/bin/python" "$@"; }

cp -r 0.orig 0
run blockMesh
