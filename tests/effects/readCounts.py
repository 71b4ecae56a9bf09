"""Counts of callgrind in the time steps of cases, a file callgrind.<n> for each.

    equal A B CLASSES   is the step of B that of A? Prints "instructions ..." if it is:
                        as many within 0.1 %, no other functions, no more calls of malloc,
                        and no function of CLASSES (a regular expression) in either
    step A              instructions of a step
    share A FUNCTIONS   the part of a step's instructions in calls of functions (a regular
                        expression) from others, and in what those call
"""
import glob
import re
import sys


def read(file):
    total, functions, allocations, called = 0, set(), 0, None
    for line in open(file):
        if line.startswith("fn="):
            # Functions of the C library come and go with the state of its heap; a source that
            # is not active is asked that
            if "Foam::" in line and "isActive" not in line:
                functions.add(line[3:].strip())
        elif line.startswith("cfn="):
            called = line[4:].strip()
        elif line.startswith("calls="):
            if called in ("malloc", "calloc", "realloc", "posix_memalign", "memalign"):
                allocations += int(line[6:].split()[0])
        elif line.startswith("totals:"):
            total = int(line.split()[1])
    return total, functions, allocations


def step(case):
    """The step with the median of the instructions; the first two make what later ones keep."""
    files = [f for f in glob.glob(case + "/callgrind.[0-9]*") if int(f.rpartition(".")[2]) > 3]
    if len(files) < 3:
        sys.exit("no counts in " + case)
    return sorted(map(read, files), key=lambda s: s[0])[len(files) // 2]


def equal(a, b, classes):
    one, two = step(a), step(b)
    wrong = []
    if abs(two[0] / one[0] - 1) > 1e-3:
        wrong.append("%d instructions in place of %d" % (two[0], one[0]))
    if two[1] - one[1]:
        wrong.append("also calls " + ", ".join(sorted(two[1] - one[1])[:5]))
    if two[2] > one[2]:
        wrong.append("%d allocations in place of %d" % (two[2], one[2]))
    called = sorted(f for f in one[1] | two[1] if re.search(classes, f))
    if called:
        wrong.append("calls " + ", ".join(called[:5]))
    print("; ".join(wrong) or "instructions of a step: %+.4f %%, no function and no allocation more (%d, %d)" % (
        100 * (two[0] / one[0] - 1), len(two[1]), two[2]))


def share(case, functions):
    """Counts of the last step."""
    numbers = [int(f.rpartition(".")[2]) for f in glob.glob(case + "/callgrind.[0-9]*")]
    inside, caller, called, total, pending = 0, "", "", 0, False
    for line in open("%s/callgrind.%d" % (case, max(numbers) - 1)):
        if pending:
            if re.search(functions, called) and not re.search(functions, caller):
                inside += int(line.split()[-1])
            pending = False
        elif line.startswith("fn="):
            caller = line[3:]
        elif line.startswith("cfn="):
            called = line[4:]
        elif line.startswith("calls="):
            pending = True
        elif line.startswith("totals:"):
            total = int(line.split()[1])
    return inside / total


if sys.argv[1] == "equal":
    equal(*sys.argv[2:5])
elif sys.argv[1] == "share":
    print("%.5f" % share(*sys.argv[2:4]))
else:
    print(step(sys.argv[2])[0])
