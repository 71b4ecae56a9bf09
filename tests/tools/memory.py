"""Memory that programs take."""
import glob
import re
import resource
import subprocess


def largest(*command):
    """Largest resident memory of a command, in bytes."""
    subprocess.run(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, check=True)
    return 1024 * resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss


def text(pid, file):
    try:
        with open("/proc/%d/%s" % (pid, file), errors="replace") as f:
            return f.read()
    except OSError:
        return ""


def number(pattern, text):
    return int((re.findall(pattern + r"\s*(\d+)", text) or [0])[0])


def descends(pid, ancestor):
    while pid > 1 and pid != ancestor:
        pid = number("PPid:", text(pid, "status"))
    return pid == ancestor


def solvers(ancestor):
    """Processes of deformableBodyFoam that one process started, by rank."""
    pids = [int(folder[6:]) for folder in glob.glob("/proc/[0-9]*")]
    pids = [p for p in pids if text(p, "comm").strip() == "deformableBodyF" and descends(p, ancestor)]
    return sorted(pids, key=lambda p: number("OMPI_COMM_WORLD_RANK=", text(p, "environ")))


def steps(*command):
    """Largest resident memory of each rank of a solver until its second step, and from
    then until its fourth, in bytes: a line a rank."""
    peaks = lambda: [1024 * number("VmHWM:", text(p, "status")) for p in pids]
    run = subprocess.Popen(command, stdout=subprocess.PIPE, universal_newlines=True)
    step = 0
    for line in run.stdout:
        if not line.startswith("Time = "):
            continue
        step += 1
        if step == 2:
            pids = solvers(run.pid)
            before = peaks()
            for p in pids:
                # The kernel forgets the largest so far
                with open("/proc/%d/clear_refs" % p, "w") as f:
                    f.write("5")
        elif step == 4:
            after = peaks()
    if run.wait():
        raise SystemExit(1)
    for pair in zip(before, after):
        print("%d %d" % pair)
