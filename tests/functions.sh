# Sourced by the test scripts: counting, cases, and comparing numbers

. "$(dirname "${BASH_SOURCE[0]}")/../bin/env" || exit 1
runs=$DEFORMABLE_BODIES_DIR/tests/run

passed=0
failed=0

# check "what" command...: one test, passed if the command succeeds
check()
{
    local what=$1
    shift
    if "$@"
    then
        echo "pass: $what"
        passed=$((passed + 1))
    else
        echo "FAIL: $what"
        failed=$((failed + 1))
    fi
}

# below "what" value limit: prints both
below()
{
    # Not a number, by whatever name, is no success
    check "$1: $2 (limit $3)" awk -v x="$2" -v l="$3" \
        'BEGIN { exit !(x ~ /^[-+]?[0-9.]+(e[-+]?[0-9]+)?$/ && x + 0 <= l + 0) }'
}

# The last line of every test script: what was counted, and the exit status
finish()
{
    echo "$passed passed, $failed failed"
    [ "$failed" -eq 0 ]
    exit
}

# relative <a> <b>: difference, relative to b
relative() { awk -v a="$1" -v b="$2" 'BEGIN { d = a/b - 1; print d < 0 ? -d : d }'; }

# column <name> <file>: of a .dat file of bodies
column()
{
    awk -v c="$1" '/^#/ { for (i = 2; i <= NF; ++i) n[$i] = i - 1; next }
        { print $n[c] }' "$2"
}

mpi() { timeout 900 mpirun --bind-to none --oversubscribe "$@"; }

# shearCase <folder> [entry value]...: the tutorial's case, small by default
# (a/h = 3, 20 steps), with other values in constant/scene; mesh and start
# fields made
shearCase()
{
    local dir=$1
    shift
    rm -rf "$dir"
    mkdir -p "$(dirname "$dir")"
    (cd "$DEFORMABLE_BODIES_DIR/tutorials/capsule/shear" &&
        mkdir "$dir" && cp -r 0.orig constant system "$dir")
    cd "$dir" || return 1
    rm -rf constant/polyMesh
    set -- cells 24 dt 0.01 endTime 0.2 "$@"
    while [ $# -gt 0 ]
    do
        sed -i "s/^$1 .*/$1 $2;/" constant/scene
        shift 2
    done
    sed -i 's/^writeInterval.*/writeInterval 0.1;/' system/controlDict
    # Runs are compared to round-off: iterate well beyond what physics needs
    sed -i 's/tolerance  *1e-[789];/tolerance 1e-13;/' system/fvSolution
    sed -i "s/^PIMPLE$/PIMPLE { flowAlgorithm ${FLOW:-auto}; } PIMPLE/" \
        system/fvSolution
    cp -r 0.orig 0
    blockMesh > log.blockMesh 2>&1 && setExprFields > log.setExprFields 2>&1
}

# parallel <n> "(nx ny nz)" <command>: decomposed copy of the case in here
parallel()
{
    sed -i "s/^numberOf.*/numberOfSubdomains $1;/; s/^ *n  *(.*/    n $2;/" \
        system/decomposeParDict
    decomposePar -force > log.decomposePar 2>&1 &&
        mpi -np "$1" "$3" -parallel > "log.$3" 2>&1
}

# difference <file> <file> [table]: largest difference of two .dat files over
# the rows of equal time and body, relative to the largest value of the column
# (columns that are zero to round-off count absolutely). table: rows of equal
# time, all columns relative
difference()
{
    "$DEFORMABLE_BODIES_DIR/bin/python" - "$@" <<'END'
import sys
import numpy as np
a, b = (np.loadtxt(f, ndmin=2) for f in sys.argv[1:3])
keys, floor = (1, 0) if sys.argv[3:] == ["table"] else (2, 1)
key = lambda r: (round(r[0], 9), *r[1:keys])
rows = {key(r): r for r in b}
common = [(r, rows[key(r)]) for r in a if key(r) in rows]
# A run that broke off is no agreement
if not common or a[-1][0] != b[-1][0]:
    print("nan")
    sys.exit()
x, y = (np.array(v)[:, keys:] for v in zip(*common))
print("%.2e" % (np.abs(x - y) / np.maximum(np.abs(x).max(0), floor)).max())
END
}

# sceneCase <family/scene> <folder> [entry value]...: a tutorial with
# other values in constant/scene; mesh and start fields made
sceneCase()
{
    local scene=$1 dir=$2
    shift 2
    rm -rf "$dir"
    mkdir -p "$dir"
    cp -r "$DEFORMABLE_BODIES_DIR/tutorials/$scene"/{0.orig,constant,system} "$dir"
    cd "$dir" || return 1
    rm -rf constant/polyMesh
    while [ $# -gt 0 ]
    do
        sed -i "s/^$1 .*/$1 $2;/" constant/scene
        shift 2
    done
    cp -r 0.orig 0
    blockMesh > log.blockMesh 2>&1
    [ ! -e system/setExprFieldsDict ] || setExprFields > log.setExprFields 2>&1
}

# peak <command>...: largest resident memory in bytes
peak()
{
    "$DEFORMABLE_BODIES_DIR/bin/python" - "$@" <<'PY'
import resource, subprocess, sys
subprocess.run(sys.argv[1:], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
print(1024 * resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss)
PY
}

# The shear case in here, periodic all round and at rest
makePeriodic()
{
    sed -i 's/bottom { type wall;/bottom { type cyclic; neighbourPatch top;/
        s/top    { type wall;/top { type cyclic; neighbourPatch bottom;/' \
        system/blockMeshDict
    blockMesh > log.blockMesh 2>&1 || return 1
    cat > 0/U <<'U'
FoamFile { version 2.0; format ascii; class volVectorField; object U; }
dimensions [0 1 -1 0 0 0 0];
internalField uniform (0 0 0);
boundaryField { ".*" { type cyclic; } }
U
    sed 's/volVectorField/volScalarField/; s/object U/object p/
        s/1 -1 0/2 -2 0/; s/(0 0 0)/0/' 0/U > 0/p
}
