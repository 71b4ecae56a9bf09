"""Runs of copies of a case with other settings, kept for the next command, and their results:
sweep, and what accuracyCost and effectPrice share."""
import argparse
import glob
import hashlib
import json
import math
import os
import re
import shutil
import signal
import subprocess
import sys
import time
from .case import Case

perType = {"capsule": {"harmonics", "markerSpacing", "nearField", "motion"},
           "filament": {"segments", "scheme"}, "rigid": {"markerSpacing", "nearField"}}
quantities = ["D", "tipY", "angle", "velocity", "x"]


def die(text):
    print("%s: %s" % (os.path.basename(sys.argv[0]).replace(".py", ""), text), file=sys.stderr)
    sys.exit(1)


class Failed(Exception):
    pass


class NotOfTheCase(Failed):
    """The request is wrong, or there is too little time: the case may be right."""


class OutOfTime(NotOfTheCase):
    """The budget is used up: the same command with a larger one continues."""


def percent(share):
    return "%.*f %%" % (0, 100 * share) if abs(share) >= 0.995 else "%.2g %%" % (100 * share)


def seconds(text):
    match = re.fullmatch(r"([0-9]+\.?[0-9]*|\.[0-9]+) *(s|min|h)?", text)
    if not match or float(match[1]) <= 0:
        die("--budget is '%s', allowed: a time such as 90s, 30min or 2h" % text)
    return float(match[1]) * {"s": 1, None: 1, "min": 60, "h": 3600}[match[2]]


def checkCase(case):
    path = os.path.abspath(case)
    if not os.path.isfile(path + "/system/controlDict"):
        die("%s is no case: there is no system/controlDict" % case)
    if re.search(r"\s", path + os.getcwd()):
        die("OpenFOAM takes no paths with blanks: '%s', '%s'" % (path, os.getcwd()))


def clock(t):
    return "%d:%02d:%02d" % (t // 3600, t // 60 % 60, t % 60)


def dictionary(file, *arguments):
    done = subprocess.run(["foamDictionary", file, "-disableFunctionEntries", "-precision", "17", *arguments],
                          stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, universal_newlines=True)
    return done.stdout if done.returncode == 0 else None


def put(folder, file, entry, value):
    """Set an entry; its dictionary must be there."""
    path = os.path.join(folder, file)
    if not os.path.isfile(path):
        raise Failed("there is no file " + file)
    parent = entry.rpartition("/")[0]
    keys = dictionary(path, *(["-entry", parent] if parent else []), "-keywords")
    if keys is None:
        raise Failed("%s has no dictionary %s" % (file, parent))
    there = entry.rpartition("/")[2] in keys.split()
    if dictionary(path, "-entry", entry, "-set" if there else "-add", value) is None:
        raise Failed("%s does not take %s %s" % (file, entry, value))


def isUsed(folder, name):
    """A dictionary of a case expands a variable: $name, ${name}, $:name or $:variables.name."""
    use = re.compile(r"\$\{?[:.]*(variables\.)?%s(?![\w])" % re.escape(name))
    for kind in ("constant", "system", "0", "0.orig"):
        for path, _, files in os.walk(os.path.join(folder, kind)):
            for file in (os.path.join(path, f) for f in files):
                if os.path.getsize(file) < 1e6 and use.search(open(file, errors="replace").read()):
                    return True
    return False


def change(folder, name, value):
    """Give one setting its value in a copied case; None takes <file>:<entry> out."""
    if value is None:
        file, entry = name.split(":", 1)
        dictionary(os.path.join(folder, file), "-entry", entry, "-remove")
        return
    scene = os.path.join(folder, "constant/scene")
    if os.path.isfile(scene):
        text = open(scene).read()
        changed, n = re.subn(r"(?m)^%s(\s+)[^;]*;" % re.escape(name), r"%s\g<1>%s;" % (name, value), text)
        if n:
            if not isUsed(folder, name):
                raise Failed("'%s' of constant/scene is used nowhere in the case: delete it there" % name)
            open(scene, "w").write(changed)
            return
    if ":" in name:
        put(folder, *name.split(":", 1), value)
    elif name == "cells":
        path = os.path.join(folder, "system/blockMeshDict")
        if not os.path.isfile(path):
            raise Failed("there is no system/blockMeshDict whose cells could be varied")
        text = open(path).read()
        block = re.compile(r"(hex\s*\([^)]*\)\s*(?:\w+\s*)?\()\s*(\d+)\s+(\d+)\s+(\d+)\s*\)")
        first = block.search(text)
        if not first:
            raise Failed("system/blockMeshDict has no block with numbers of cells (hex (...) (nx ny nz))")
        ratio = float(value) / int(first[2])
        def scaled(m):
            n = [int(m[k]) * ratio for k in (2, 3, 4)]
            if any(abs(x - round(x)) > 1e-9 for x in n):
                raise Failed("%s cells: the others would be %s %s %s" % (value, *n))
            return "%s%d %d %d)" % (m[1], *map(round, n))
        open(path, "w").write(block.sub(scaled, text))
    elif name in ("deltaT", "maxCo", "endTime", "maxDeltaT"):
        put(folder, "system/controlDict", name, value)
    elif name in ("kernel", "accuracy"):
        put(folder, "constant/deformableBodies", name, value)
    else:
        bodies = os.path.join(folder, "constant/deformableBodies")
        groups = (dictionary(bodies, "-entry", "bodies", "-keywords") or "").split()
        fit = [g for g in groups if name in perType.get(
            (dictionary(bodies, "-entry", "bodies/%s/type" % g, "-value") or "").strip(), ())]
        if not fit:
            raise Failed("'%s' is no entry of constant/scene and no setting that a group of %s has" %
                         (name, "(" + " ".join(groups) + ")"))
        for g in fit:
            put(folder, "constant/deformableBodies", "bodies/%s/%s" % (g, name), value)


def copyCase(case, folder):
    def left(path, names):
        if os.path.abspath(path) != os.path.abspath(case):
            return {"polyMesh"} & set(names) if os.path.exists(
                os.path.join(case, "system/blockMeshDict")) else set()
        return {n for n in names if n not in ("0", "0.orig", "constant", "system")}
    shutil.copytree(case, folder, ignore=left)


def fingerprint(case):
    """Digest of the files that a run starts from: 0 or 0.orig, constant and system, without the mesh."""
    sums = hashlib.sha256()
    for start in ("0.orig" if os.path.isdir(case + "/0.orig") else "0", "constant", "system"):
        for path, folders, files in os.walk(os.path.join(case, start)):
            folders[:] = sorted(f for f in folders if f != "polyMesh")
            for name in sorted(files):
                sums.update(os.path.relpath(os.path.join(path, name), case).encode())
                with open(os.path.join(path, name), "rb") as f:
                    sums.update(f.read())
    return sums.hexdigest()


class Runs:
    def __init__(self, options):
        self.case, self.out = os.path.abspath(options.case), options.out
        self.places = None
        self.quantity, self.group, self.always = options.quantity, options.group, options.always
        self.started, self.budget = time.time(), seconds(options.budget) if options.budget else math.inf
        self.running = set()
        self.fingerprint = fingerprint(self.case)

    def endWithSignals(self):
        """A signal ends the programs that were started, too."""
        def stop(*_):
            for process in list(self.running):
                os.killpg(process.pid, signal.SIGKILL)
            os._exit(130)
        signal.signal(signal.SIGTERM, stop)
        signal.signal(signal.SIGINT, stop)

    def left(self):
        return self.budget - (time.time() - self.started)

    def read(self, folder):
        files = sorted(glob.glob(glob.escape(folder) + "/postProcessing/bodies/*/*.dat"))
        if not files:
            raise Failed("the run wrote no postProcessing/bodies/*/*.dat: does the case have bodies?")
        groups = list(dict.fromkeys(os.path.basename(file)[:-4] for file in files))
        if self.group and self.group not in groups:
            raise NotOfTheCase("there is no group '%s', allowed: %s" % (self.group, " ".join(groups)))
        seen = []
        for file in files:
            group = os.path.basename(file)[:-4]
            if self.group and group != self.group:
                continue
            with open(file) as lines:
                names = next(lines).split()[1:]
            seen += names[2:]
            rows = [line.split() for line in open(file) if line[0] != "#"]
            wanted = [self.quantity] if self.quantity else quantities
            if "velocity" in wanted and rows:
                # Mean velocity of a body
                ways = [n for n in names if re.fullmatch("velocity[XYZ]", n)]
                ways.sort(key=lambda n: -abs(float(rows[-1][names.index(n)])))
                wanted = wanted[:3] + ways[:1] + wanted[4:]
            name = next((q for q in wanted if q in names[2:]), None)
            if name is None:
                continue
            at = {}
            for r in rows:
                at.setdefault(float(r[0]), []).append(float(r[names.index(name)]))
            at = {t: sum(v) / len(v) for t, v in at.items()}
            if len(at) < 2:
                raise Failed("%s has one sample only: a later endTime, or sampleInterval 1" % os.path.basename(file))
            if not math.isfinite(at[max(at)]):
                raise Failed("%s is not a number" % name)
            return {"value": at[max(at)], "quantity": name, "time": max(at), "values": at}
        raise NotOfTheCase("there is no quantity '%s'%s, allowed: %s" % (
            self.quantity, " of group " + self.group if self.group else "", " ".join(dict.fromkeys(seen))))

    def made(self, label, settings, repeats=2):
        """Folder of one run with settings (name, value), and its changes and core seconds: from
        an earlier command, or a new run."""
        changes = self.always + settings
        folder = os.path.join(self.out, "runs", re.sub(r"[^A-Za-z0-9_.=+-]", "_", label))
        record = os.path.join(folder, "done.json")
        if os.path.isfile(record):
            result = json.load(open(record))
            if (result["changes"], result.get("case")) == ([list(c) for c in changes], self.fingerprint):
                return folder, result
        taken = self.once(folder, changes)
        # Short runs: the fastest of three, as other jobs slow down single runs
        again = folder + "~"
        for _ in range(repeats if taken < 1 and self.left() > 10 * taken else 0):
            more = self.once(again, changes)
            if more < taken:
                taken = more
                shutil.rmtree(folder)
                os.rename(again, folder)
            else:
                shutil.rmtree(again)
        result = {"changes": changes, "case": self.fingerprint, "seconds": taken}
        with open(record + ".part", "w") as f:
            json.dump(result, f)
        os.rename(record + ".part", record)
        return folder, result

    def run(self, label, settings):
        """Result of one run with settings."""
        folder, result = self.made(label, settings)
        return dict(result, **self.read(folder))

    def placesOfCase(self):
        """Random positions of the case as it stands, by seedBodies: dictionary and file of each
        group with a placement. All runs start from these positions, as the same seed may give
        others on another mesh."""
        if self.places is None:
            self.places = {}
            bodies = os.path.join(self.case, "constant/deformableBodies")
            groups = (dictionary(bodies, "-entry", "bodies", "-keywords") or "").split()
            groups = [g for g in groups if dictionary(bodies, "-entry", "bodies/%s/placement" % g) is not None]
            if groups:
                folder = os.path.join(self.out, "places")
                shutil.rmtree(folder, ignore_errors=True)
                copyCase(self.case, folder)
                for name, value in self.always:
                    change(folder, name, value)
                for program in ("blockMesh", "seedBodies"):
                    if program == "blockMesh" and not os.path.exists(folder + "/system/blockMeshDict"):
                        continue
                    with open("%s/log.%s" % (folder, program), "w") as log:
                        if subprocess.run([program], cwd=folder, stdout=log, stderr=log).returncode != 0:
                            raise Failed("%s stopped (%s)" % (program, log.name))
                self.places = {g: "%s/constant/%sPlaces" % (folder, g) for g in groups}
        return self.places

    def placesChange(self, group, changes):
        """True if the placement of a group uses a variable that is changed."""
        text = dictionary(self.case + "/constant/deformableBodies", "-entry", "bodies/%s/placement" % group) or ""
        return any(re.search(r"\$\{?%s\b" % re.escape(re.split("[:/]", name)[-1]), text) for name, _ in changes)

    def once(self, folder, changes):
        """Core seconds of the solver on a copy of the case with changes."""
        shutil.rmtree(folder, ignore_errors=True)
        copyCase(self.case, folder)
        if not any("placement" in name for name, _ in changes):
            bodies = "constant/deformableBodies"
            for group, file in self.placesOfCase().items():
                if self.placesChange(group, changes):
                    continue
                put(folder, bodies, "bodies/%s/placesFrom" % group, '"%s"' % file)
                change(folder, "%s:bodies/%s/placement" % (bodies, group), None)
                text = open(os.path.join(folder, bodies)).read()
                with open(os.path.join(folder, bodies), "w") as f:
                    f.write(re.sub(r'placesFrom\s+("[^"]*");', r"#include \1", text))
        for name, value in changes:
            change(folder, name, value)
        if os.path.isdir(folder + "/0.orig"):
            # Fields of the case may belong to another mesh
            shutil.rmtree(folder + "/0", ignore_errors=True)
            shutil.copytree(folder + "/0.orig", folder + "/0")
        solver = (dictionary(folder + "/system/controlDict", "-entry", "application", "-value") or "").strip()
        if not solver:
            raise Failed("system/controlDict names no application")
        programs = [p for p, needs in (("blockMesh", "system/blockMeshDict"),
                                       ("setExprFields", "system/setExprFieldsDict"))
                    if os.path.exists(os.path.join(folder, needs))] + [solver]
        for program in programs:
            if self.left() <= 0:
                raise OutOfTime("the budget is used up")
            with open("%s/log.%s" % (folder, program), "w") as log:
                process = subprocess.Popen([program], cwd=folder, stdout=log, stderr=log, start_new_session=True)
                self.running.add(process)
                try:
                    status = process.wait(None if self.budget == math.inf else max(1, self.left()))
                except subprocess.TimeoutExpired:
                    os.killpg(process.pid, signal.SIGKILL)
                    process.wait()
                    raise OutOfTime("the budget ended during this run")
                finally:
                    self.running.discard(process)
            text = open(log.name).read()
            if status != 0 or "FOAM FATAL" in text:
                found = re.search(r"FOAM FATAL[^\n]*\n(.*?)\n\s*\n", text, re.S)
                raise Failed("%s stopped: %s (%s)" % (
                    program, "; ".join(filter(None, map(str.strip, found[1].splitlines()))) if found
                    else "status %d" % status, log.name))
        # Unit: 1/100
        times = re.findall(r"ExecutionTime = ([0-9.]+) s", text)
        return max(0.01, float(times[-1])) if times else math.nan


def sweep(case, out, settings):
    """Runs copies of a case in out/runs, one for each dictionary of settings (names as of
    accuracyCost, such as {"Ca": 0.1, "deltaT": 1e-3}), and yields the settings and the Case of
    each. Runs of an earlier call that are finished are not repeated. Failed: a run stopped."""
    if not os.path.isfile(os.path.join(case, "system/controlDict")):
        raise Failed("%s is no case: there is no system/controlDict" % case)
    if os.path.abspath(out).startswith(os.path.abspath(case) + os.sep):
        raise Failed("%s lies in the case, which is not touched: run it elsewhere" % out)
    runs = Runs(argparse.Namespace(case=case, out=os.path.abspath(out), quantity=None, group=None, always=[],
                                   budget=None))
    runs.places = {} # each run has its own
    for some in settings:
        changes = [(name, str(value)) for name, value in some.items()]
        folder, _ = runs.made(",".join("%s=%s" % c for c in changes) or "asItStands", changes, repeats=0)
        yield some, Case(folder)


def atOneTime(results):
    """Values of all runs at the last time of which all have samples."""
    common = None
    for r in results:
        times = {round(t, 12): t for t in r["values"]}
        common = set(times) if common is None else common & set(times)
    if not common or max(common) <= min(min(r["values"]) for r in results):
        raise Failed("it has samples at no time of the others: sampleInterval 1, or steps that divide each other")
    for r in results:
        r["time"] = max(common)
        r["value"] = next(v for t, v in r["values"].items() if round(t, 12) == r["time"])
    return results


def readOptions(tool, description, add=lambda parser: None):
    """Options common to the tools, and those that add(parser) adds. Wrong common options end
    the program."""
    parser = argparse.ArgumentParser(prog=tool, description=description,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("case", help="folder of a case that runs")
    add(parser)
    parser.add_argument("--set", action="append", default=[], dest="always", metavar="NAME=VALUE",
                        help="another value in all runs, such as endTime=0.5 (names: accuracyCost --help)")
    parser.add_argument("--quantity", help="column of a .dat file of the bodies, at the last time, on average "
                        "over the bodies (default: the first there is of " + " ".join(quantities) +
                        "; velocity: its largest component)")
    parser.add_argument("--group", help="of this group of bodies")
    parser.add_argument("--budget", help="wall time for all runs, such as 90s, 30min, 2h")
    parser.add_argument("--out", help="output folder (default: %s.<case>, here)" % tool)
    options = parser.parse_args()
    checkCase(options.case)
    options.case = os.path.abspath(options.case)
    options.out = os.path.abspath(options.out or tool + "." + os.path.basename(options.case))
    if options.out.startswith(options.case + os.sep):
        die("--out %s lies in the case, which is not touched: run it elsewhere" % options.out)
    for given in options.always:
        if not re.fullmatch("[^=]+=[^=]+", given):
            die("--set is '%s', allowed: a name and a value, such as endTime=0.5" % given)
    options.always = [tuple(given.split("=")) for given in options.always]
    return options


def guarded(main):
    """Run main; a reader of the output that closes the pipe is no error."""
    try:
        main()
    except BrokenPipeError:
        os._exit(1)
