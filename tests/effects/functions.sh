# Sourced by run and prices: scenes, and what a step of them does

. ../functions.sh
readCounts=$PWD/readCounts.py
# Kept: it is built once for both
portable=$DEFORMABLE_BODIES_DIR/tests/run/portable

# buildPortable: this checkout without vector instructions, which callgrind does not know
buildPortable()
{
    mkdir -p "$portable"
    (cd "$DEFORMABLE_BODIES_DIR" && git ls-files -coz --exclude-standard ':!tests' | tar -c --null -T - | tar -x -C "$portable")
    check "build without vector instructions" eval \
        '(export DEFORMABLE_BODIES_ARCH=portable; . "$portable/bin/env" && "$portable/Allwmake" -j 2) > "$portable.log" 2>&1'
}

# scene <folder> <group's text> [entry value]...: bodies in a shear box, Re 10, eight steps
scene()
{
    local dir=$1 group=$2
    shift 2
    shearCase "$dir" Re 10 cells 16 endTime 0.08 "$@"
    # Entries of the tutorial for stock solvers
    rm constant/fvOptions
    entry system/controlDict writeInterval "$(awk '$1 == "endTime" { print $2 / 2 }' constant/scene)" writeFormat binary
    cat > constant/deformableBodies <<END
FoamFile { version 2.0; format ascii; class dictionary; object deformableBodies; }
variables { #include "scene" }
bodies { group { $group } }
END
    echo 'FoamFile { version 2.0; format ascii; class uniformDimensionedVectorField; object g; } dimensions [0 1 -2 0 0 0 0]; value (0 -1 0);' > constant/g
}

# add <file> <text>: text added to a file (group: to the group's dictionary, PIMPLE: to
# that of fvSolution)
add()
{
    if [ "$1" = group ]
    then
        replace constant/deformableBodies "s/bodies { group { /&$2 /"
    elif [ "$1" = PIMPLE ]
    then
        replace system/fvSolution "/^PIMPLE/,/{/ s/{/{ $2/"
    else
        [ -e "$1" ] || echo "FoamFile { version 2.0; format ascii; class dictionary; object ${1##*/}; }" > "$1"
        echo "$2" >> "$1"
    fi
}

# counted: the case in here again, from its start under callgrind: counted/callgrind.<step>
counted()
{
    mkdir counted
    cp -r 0 constant system counted
    (
        . "$portable/bin/env"
        cd counted && valgrind --tool=callgrind --compress-strings=no --dump-before='Foam::Time::operator++()' \
            --callgrind-out-file=callgrind deformableBodyFoam
    ) > counted/log 2>&1 || notChanged "callgrind failed"
}
