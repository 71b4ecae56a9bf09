# Sourced by the test scripts: counting, cases, and comparing numbers

. "$(dirname "${BASH_SOURCE[0]}")/../bin/env" || exit 1
runs=${DEFORMABLE_BODIES_RUNS:-$DEFORMABLE_BODIES_DIR/tests/run}
[[ $runs = /* ]] || { echo "DEFORMABLE_BODIES_RUNS is '$runs', it must begin with /" 1>&2; exit 1; }
mkdir -p "$runs"

passed=0
failed=0

# How much of a script runs: with -quick one scene for each of its claims, with -long also
# what takes long or shows the same again. Scripts of one length take no notice
extent=default
for argument
do
    case $argument in -quick | -long) extent=${argument#-} ;; esac
done
isQuick() { [ "$extent" = quick ]; }
isLong() { [ "$extent" = long ]; }

# Arguments name points of a study, in full or by their beginning. None: all points
wanted=()
for argument
do
    case $argument in -*) ;; *) wanted+=("$argument") ;; esac
done
asked()
{
    local beginning
    [ ${#wanted[@]} -gt 0 ] || return 0
    for beginning in "${wanted[@]}"
    do
        [[ $1 != "$beginning"* ]] || return 0
    done
    return 1
}

# isMissing <point> <folder>: to be run, as it is asked for and was not run to its end
isMissing() { isLong && asked "$1" && ! [ -e "$2/done" ]; }

# hasState <folder>: of a run that was broken off
hasState() { ls "$1"/[1-9]* > /dev/null 2>&1; }

# toItsEnd <point> <folder>: begins or goes on from the last state; leaves the file done
toItsEnd()
{
    cd "$2" || return
    deformableBodyFoam > "log.run.$(ls log.run.* 2> /dev/null | wc -l)" 2>&1 && touch done
    check "$1 runs to its end" test -e done
}

# End of a script with -quick
endOfQuick() { ! isQuick || finish; }

# Files of this script. lost: a line for each change of a file that could not be made, as
# subshells cannot count
scratch=$(mktemp -d) || exit 1
trap 'rm -rf "$scratch"' EXIT
lost=$scratch/lost
: > "$lost"

# check "what" command...: one test, passed if the command succeeds; its status
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
        return 1
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
    failed=$((failed + $(wc -l < "$lost")))
    [ $((passed + failed)) -gt 0 ] || check "something is tested: a scene of that name, or a run that was kept" false
    echo "$passed passed, $failed failed"
    [ "$failed" -eq 0 ]
    exit
}

# allPassed: nothing has failed so far
allPassed() { [ "$failed" -eq 0 ] && [ ! -s "$lost" ]; }

# notChanged "what": a failure, since what follows would test something else
notChanged()
{
    echo "FAIL: $1 (in $PWD)" 1>&2
    echo >> "$lost"
}

# entry <file> <entry> <value> [<entry> <value>]...
# entry -add <file> <entry> <value> [<entry> <value>]...
# entry -remove <file> <entry>...
# Changes entries that the dictionary has, adds some that it has not, or removes
# some: name, or bodies/cells/harmonics in sub-dictionaries, or solvers/U.*/tolerance
# (without the quotes of the key). #include, #eval and $variables stay as they are,
# comments are lost.
entry()
{
    local action=-set file name parent keys has value text line old parts
    case $1 in -add | -remove) action=$1; shift ;; esac
    file=$1
    shift
    while [ $# -gt 0 ]
    do
        name=$1 parent='' value=() has=no
        shift
        [[ $name != */* ]] || parent=${name%/*}
        if [ $action != -remove ]
        then
            value=("$1")
            shift
        fi
        # One line of its own that begins with the name: much quicker than foamDictionary
        if [[ $action = -set && $name =~ ^[A-Za-z]+$ && $file =~ ^(constant|system)/ &&
            ! ${value[0]} =~ [\;\|\&\\$'\n'] ]]
        then
            text=$'\n'$(< "$file")
            line=$'\n'$name$'[ \t]+' old=$'[^ \t;{}\n][^;{}\n]*;'
            if [[ $text =~ ^(.*)($line)$old(.*)$ ]] && parts=("${BASH_REMATCH[@]:1}") &&
                [[ ! ${parts[0]} =~ $line$old ]]
            then
                text="${parts[0]}${parts[1]}${value[0]};${parts[2]}"
                echo "${text#?}" > "$file"
                continue
            fi
        fi
        # foamDictionary sets what is not there, removes what is not there, and
        # drops what follows the end of an entry, all with status 0
        if ! keys=$(dictionary "$file" ${parent:+-entry "$parent"} -keywords)
        then
            notChanged "$file has no dictionary ${parent:-that can be read}"
            continue
        fi
        ! grep -qxF -e "${name##*/}" -e "\"${name##*/}\"" <<< "$keys" || has=yes
        if [ $action = -add ] && [ $has = yes ]
        then
            notChanged "$file already has an entry $name"
        elif [ $action != -add ] && [ $has = no ]
        then
            notChanged "$file has no entry $name"
        elif [[ ${value[0]-} == *';'* && ! ${value[0]} =~ ^[[:space:]]*\{.*\}$ ]] ||
            ! dictionary "$file" -entry "$name" $action "${value[@]}" > /dev/null
        then
            notChanged "$file: $name does not take $action ${value[*]}"
        fi
    done
}

# dictionary <file> <options of foamDictionary>: all digits of the numbers are kept
dictionary()
{
    foamDictionary "$1" -disableFunctionEntries -precision 17 "${@:2}" 2> /dev/null
}

# replace <file> <script of sed>...: text that is no entry, such as the dictionaries
# in lists. Each script must change something
replace()
{
    local file=$1 script
    shift
    for script
    do
        sed "$script" "$file" > "$file.replaced"
        if cmp -s "$file" "$file.replaced"
        then
            notChanged "$file has nothing that $script would change"
        fi
        mv "$file.replaced" "$file"
    done
}

# timeout <seconds> <command>...: what does not end when asked to is killed
timeout() { command timeout --kill-after=10 "$@"; }

# stops "what" "pattern" <command>...: the command ends with another status than 0,
# within ten minutes (mpi: its own limit), and its output has the sentence (a regular
# expression; line breaks count as blanks)
stops() { outcome stops "$@"; }

# goesOn "what" "pattern" <command>...: the same with status 0
goesOn() { outcome goesOn "$@"; }

outcome()
{
    local expected=$1 what=$2 pattern=$3 status
    shift 3
    [ "$1" = mpi ] || set -- timeout 600 "$@"
    "$@" > log.outcome 2>&1
    status=$?
    # 124, 137: not within the limit
    check "$what: $expected" \
        test "$( ((status == 0)) && echo goesOn || echo stops)" = "$expected" \
        -a $status -ne 124 -a $status -ne 137
    check "    says: $pattern" \
        grep -qE -e "$pattern" <(tr '\n' ' ' < log.outcome | tr -s ' ')
}

# googleTests <command>...: its output, and its tests counted with those of this
# script
googleTests()
{
    local log=$PWD/log.googleTests status ran
    GTEST_COLOR=no "$@" 2>&1 | tee "$log"
    status=${PIPESTATUS[0]}
    ran=$(sed -n 's/.*PASSED.* \([0-9]*\) tests\?\..*/\1/p' "$log" | tail -n 1)
    passed=$((passed + ${ran:-0}))
    if [ "${ran:-0}" = 0 ] && [ "$status" -eq 0 ]; then status=1; fi
    ran=$(grep -c 'FAILED.*ms)' "$log")
    [ "$status" -eq 0 ] || [ "$ran" -gt 0 ] || ran=1
    failed=$((failed + ran))
}

# judgeTrends <module> <table>: each claim of its function trends, by the pairs of rows that there are
judgeTrends()
{
    local module=$1 table=$2 claim value claims
    check "$module: trends are judged" eval 'claims=$(tool "$module.trends" "$table")'
    while IFS='|' read -r claim value
    do
        if [ "$value" = none ]
        then
            echo "    no rows yet: $claim"
        elif [ -n "$claim" ]
        then
            below "$claim" "$value" 0
        fi
    done <<< "$claims"
}

# tool <module>.<function> [arguments]: what a function of tests/tools returns
tool() { "$DEFORMABLE_BODIES_DIR/bin/python" "$DEFORMABLE_BODIES_DIR/tests/tools/call.py" "$@"; }

# Limits of the difference of runs on different ranks, relative to the largest value of each
# column. Sums are made in one order: 2e-14 at most is measured. Newton's method of fibres
# leaves 1e-12 of their lengths: 2e-12 is measured
ranksLimit=1e-12
fibresLimit=1e-11

# seconds <log>: processor time of a run
seconds() { awk '/^ExecutionTime/ { s = $3 } END { print s }' "$1"; }

# median <file>: of its numbers
median() { sort -g "$1" | awk '{ x[NR] = $1 } END { print (x[int((NR + 1)/2)] + x[int(NR/2) + 1])/2 }'; }

# relative <a> <b>: difference, relative to b
relative() { awk -v a="$1" -v b="$2" 'BEGIN { d = a/b - 1; print d < 0 ? -d : d }'; }

# column <name> <file>: of a .dat file of bodies; nan where it has none of that name
column()
{
    awk -v c="$1" '/^#/ { for (i = 2; i <= NF; ++i) n[$i] = i - 1; next }
        { print (c in n ? $n[c] : "nan") }' "$2"
}

# mpi -np <ranks> <command>...: within a quarter of an hour
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
    entry constant/scene cells 24 dt 0.01 adjustTimeStep no endTime 0.2 "$@"
    replace constant/deformableBodies '/^accuracy/d'
    replace constant/deformableBodies "s/^\( *\)type *capsule;/&\n\1harmonics 16;/"
    entry system/controlDict writeInterval 0.1
    # Runs are compared to round-off: iterate well beyond what physics needs
    tolerances 1e-13
    replace system/fvSolution "/^PIMPLE/,/{/ s/{/{\n    flowAlgorithm ${FLOW:-auto};/"

    # Small meshes and their start fields are made once in a script
    local made
    made=$scratch/mesh$(sed -n 's/^\(half\|cells\) *\([0-9.]*\);.*/.\2/p' constant/scene | tr -d '\n')
    if [ -e "$made" ]
    then
        cp -r "$made/0" . && cp -r "$made/polyMesh" constant
        return
    fi
    cp -r 0.orig 0
    blockMesh > log.blockMesh 2>&1 && setExprFields > log.setExprFields 2>&1 || return 1
    [ "$(sed -n 's/^cells *\([0-9]*\);.*/\1/p' constant/scene)" -gt 32 ] ||
        { mkdir "$made" && cp -r 0 constant/polyMesh "$made"; }
}

# tolerances <value>: of all linear solvers of the case in here
tolerances() { replace system/fvSolution "s/\<tolerance  *[^ ;]*;/tolerance $1;/"; }

# parallel <n> "(nx ny nz)" <command>: decomposed copy of the case in here; with
# "" the method chooses the blocks. By another method than uniformBoxes: method
# and coefficients are given as variables
parallel()
{
    local coefficients=${coefficients:-${2:+n $2;}}
    cat > system/decomposeParDict <<END
FoamFile { version 2.0; format ascii; class dictionary; object decomposeParDict; }
numberOfSubdomains $1;
method ${method:-uniformBoxes};
coeffs { $coefficients }
END
    decomposePar -force > log.decomposePar 2>&1 &&
        mpi -np "$1" "$3" -parallel > "log.$3" 2>&1
}

# difference <file> <file> [table]: largest difference of two .dat files over
# the rows of equal time and body, relative to the largest value of the column
# (columns that are zero to round-off count absolutely). table: rows of equal
# time, all columns relative
difference()
{
    tool dat.difference "$@"
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
    [ $# -eq 0 ] || entry constant/scene "$@"
    cp -r 0.orig 0
    blockMesh > log.blockMesh 2>&1
    [ ! -e system/setExprFieldsDict ] || setExprFields > log.setExprFields 2>&1
}

# peak <command>...: largest resident memory in bytes
peak() { tool memory.largest "$@" || notChanged "$* failed"; }

# The shear case in here, periodic all round and at rest
makePeriodic()
{
    replace system/blockMeshDict \
        's/bottom { type wall;/bottom { type cyclic; neighbourPatch top;/' \
        's/top    { type wall;/top { type cyclic; neighbourPatch bottom;/'
    blockMesh > log.blockMesh 2>&1 || return 1
    cat > 0/U <<'U'
FoamFile { version 2.0; format ascii; class volVectorField; object U; }
dimensions [0 1 -1 0 0 0 0];
internalField uniform (0 0 0);
boundaryField { ".*" { type cyclic; } }
U
    cat > 0/p <<'P'
FoamFile { version 2.0; format ascii; class volScalarField; object p; }
dimensions [0 2 -2 0 0 0 0];
internalField uniform 0;
boundaryField { ".*" { type cyclic; } }
P
}

# scattered <number> <half x> <half y> <half z> [<length> <gap>]: the entries
# positions and directions of filaments anywhere in a box about the origin; those
# of a length end that far from the walls in y
scattered() { tool scenes.scattered "$@"; }
