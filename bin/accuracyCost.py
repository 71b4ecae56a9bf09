"""What accuracy of a case costs in time.

Runs copies of a case (the case itself is not touched), each with one setting changed, and
compares a quantity of the bodies at the end. Of each setting that is varied the error of
its values is what they differ from its limit: Richardson's, where the three finest values
approach one at a steady order, else the finest. Written to the output folder are a table
(accuracyCost.csv), a picture (accuracyCost.png: error against core seconds, a line for each
setting, the cheapest marked) and, printed, which combination is the cheapest for 1, 0.3 and
0.1 %. Errors of different settings are added, costs multiplied.

Of settings that are words (nearField, kernel, ...) the last value is taken to be right. The
case's own value is part of the comparison only where it is among those given. Each run starts from 0.orig where the case has it, else from 0, after blockMesh and
setExprFields where it has their dictionaries. Runs that are done are kept: after a kill the same command goes on where it was.

    accuracyCost tutorials/capsule/shear --vary cells=24,32,48 --vary harmonics=8,12,16
    accuracyCost mine --vary deltaT=2e-3,1e-3,5e-4 --quantity inclination --budget 30min

What can be varied, coarse values first or in any order:
    any entry of constant/scene, where the case has that file (dt, cells, ...)
    cells           along the first direction of blockMeshDict, the others in proportion
    deltaT, maxCo                              in system/controlDict
    kernel, accuracy                           in constant/deformableBodies
    harmonics, markerSpacing, nearField, motion, segments, scheme
                                               in each group that may have them
    <file>:<entry>  any other, such as system/fvSolution:PIMPLE/diffusion=ADI,FFT
"""
import argparse
import csv
import glob
import hashlib
import itertools
import json
import math
import os
import re
import shutil
import signal
import subprocess
import sys
import time
from concurrent.futures import ThreadPoolExecutor

# Larger is finer, or smaller is; others are compared with the last value given
finerUp = {"cells", "harmonics", "segments"}
finerDown = {"deltaT", "dt", "maxCo", "markerSpacing", "maxDeltaT"}
words = {"nearField": ["off", "auto", "on"], "accuracy": ["draft", "standard", "reference"]}
perType = {"capsule": {"harmonics", "markerSpacing", "nearField", "motion"},
           "filament": {"segments", "scheme"}, "rigid": {"markerSpacing", "nearField"}}
quantities = ["D", "tipY", "angle", "velocityY", "velocityX", "x"]


def die(text):
    print("%s: %s" % (os.path.basename(sys.argv[0]).replace(".py", ""), text), file=sys.stderr)
    sys.exit(1)


class Failed(Exception):
    pass


def seconds(text):
    match = re.fullmatch(r"([0-9.]+) *(s|min|h)?", text)
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
    done = subprocess.run(["foamDictionary", file, "-disableFunctionEntries", *arguments],
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
    """Of what a run starts from: 0 or 0.orig, constant and system, but for the mesh."""
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
        self.quantity, self.group, self.always = options.quantity, options.group, options.always
        self.started, self.budget = time.time(), seconds(options.budget) if options.budget else math.inf
        self.running = set()
        self.fingerprint = fingerprint(self.case)

    def endWithSignals(self):
        """Programs do not outlive a signal."""
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
            raise Failed("there is no group '%s', allowed: %s" % (self.group, " ".join(groups)))
        seen = []
        for file in files:
            group = os.path.basename(file)[:-4]
            if self.group and group != self.group:
                continue
            with open(file) as lines:
                names = next(lines).split()[1:]
            seen += names[2:]
            wanted = [self.quantity] if self.quantity else quantities
            name = next((q for q in wanted if q in names[2:]), None)
            if name is None:
                continue
            at = {}
            for r in (line.split() for line in open(file) if line[0] != "#"):
                at.setdefault(float(r[0]), []).append(float(r[names.index(name)]))
            at = {t: sum(v) / len(v) for t, v in at.items()}
            if len(at) < 2:
                raise Failed("%s has one sample only: a later endTime, or sampleInterval 1" % os.path.basename(file))
            if not math.isfinite(at[max(at)]):
                raise Failed("%s is not a number" % name)
            return {"value": at[max(at)], "quantity": name, "time": max(at), "values": at}
        raise Failed("there is no quantity '%s'%s, allowed: %s" % (
            self.quantity, " of group " + self.group if self.group else "", " ".join(dict.fromkeys(seen))))

    def run(self, label, setting):
        """Result of one run, from an earlier command or made now."""
        changes = self.always + (setting if isinstance(setting, list) else [setting] if setting else [])
        folder = os.path.join(self.out, "runs", re.sub(r"[^A-Za-z0-9_.=+-]", "_", label))
        record = os.path.join(folder, "done.json")
        if os.path.isfile(record):
            result = json.load(open(record))
            if (result["changes"], result.get("case")) == ([list(c) for c in changes], self.fingerprint):
                return dict(result, **self.read(folder))
        shutil.rmtree(folder, ignore_errors=True)
        copyCase(self.case, folder)
        for name, value in changes:
            change(folder, name, value)
        if os.path.isdir(folder + "/0.orig"):
            # Fields of the case may be those of another mesh
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
                raise Failed("the budget is used up")
            with open("%s/log.%s" % (folder, program), "w") as log:
                process = subprocess.Popen([program], cwd=folder, stdout=log, stderr=log, start_new_session=True)
                self.running.add(process)
                try:
                    status = process.wait(None if self.budget == math.inf else max(1, self.left()))
                except subprocess.TimeoutExpired:
                    os.killpg(process.pid, signal.SIGKILL)
                    process.wait()
                    raise Failed("the budget ended during this run")
                finally:
                    self.running.discard(process)
            text = open(log.name).read()
            if status != 0 or "FOAM FATAL" in text:
                found = re.search(r"FOAM FATAL[^\n]*\n(.*?)\n\s*\n", text, re.S)
                raise Failed("%s stopped: %s (%s)" % (
                    program, " ".join(found[1].split()) if found else "status %d" % status, log.name))
        found = self.read(folder)
        # In hundredths
        times = re.findall(r"ExecutionTime = ([0-9.]+) s", text)
        result = {"changes": changes, "case": self.fingerprint, "seconds": max(0.01, float(times[-1])) if times else math.nan}
        with open(record + ".part", "w") as f:
            json.dump(result, f)
        os.rename(record + ".part", record)
        return dict(result, **found)


def atOneTime(results):
    """The values of all runs at the last time that all of them have samples of."""
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


def number(text):
    try:
        return float(text)
    except ValueError:
        return None


def ordered(name, values):
    if name in words:
        return sorted(values, key=lambda v: words[name].index(v) if v in words[name] else -1)
    numbers = [number(v) for v in values]
    if None in numbers or name not in finerUp | finerDown:
        return values
    return [v for _, v in sorted(zip(numbers, values), reverse=name in finerDown)]


def limitOf(name, levels):
    """The value that a setting goes to, how sure that is, and how it was found.
    levels: (setting, value of the quantity), coarse to fine."""
    fine = levels[-1][1]
    if name not in finerUp | finerDown:
        return fine, 0.0, "taken to be right: the last"
    numbers = [number(v) for v, _ in levels]
    if len(levels) < 2:
        return fine, math.nan, "one value only"
    # Two that agree by chance are no more sure than the third says
    change = max([abs(fine - levels[-2][1])] + [abs(levels[-2][1] - l[1]) / 4 for l in levels[-3:-2]])
    if len(levels) >= 3 and None not in numbers:
        h = [x if name in finerDown else 1 / x for x in numbers[-3:]]
        d1, d2 = levels[-3][1] - levels[-2][1], levels[-2][1] - fine
        if d2 != 0 and d1 / d2 > 1:
            # d1/d2 = (h0^p - h1^p)/(h1^p - h2^p) by bisection
            f = lambda p: (h[0]**p - h[1]**p) / (h[1]**p - h[2]**p) - d1 / d2
            low, high = 0.3, 5.0
            if f(low) * f(high) < 0:
                for _ in range(80):
                    middle = 0.5 * (low + high)
                    low, high = (middle, high) if f(low) * f(middle) > 0 else (low, middle)
                p = 0.5 * (low + high)
                limit = fine - d2 * h[2]**p / (h[1]**p - h[2]**p)
                return limit, abs(limit - fine), "Richardson, order %.1f" % p
    return fine, change, "the finest"


def main():
    parser = argparse.ArgumentParser(prog="accuracyCost", description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("case", help="folder of a case that runs")
    parser.add_argument("--vary", action="append", default=[], metavar="NAME=V1,V2,...",
                        help="a setting and its values; may be given several times")
    parser.add_argument("--set", action="append", default=[], dest="always", metavar="NAME=VALUE",
                        help="another value in all runs, such as endTime=0.5")
    parser.add_argument("--quantity", help="column of a .dat file of the bodies, at the last time, on average "
                        "over the bodies (default: the first there is of " + " ".join(quantities) + ")")
    parser.add_argument("--group", help="of this group of bodies")
    parser.add_argument("--budget", help="wall time for all runs, such as 90s, 30min, 2h")
    parser.add_argument("--jobs", type=int, default=1, help="runs side by side (default 1: side by side "
                        "they share the memory, and take more core seconds)")
    parser.add_argument("--out", help="output folder (default: accuracyCost.<case>, here)")
    options = parser.parse_args()
    case = os.path.abspath(options.case)
    checkCase(options.case)
    options.out = os.path.abspath(options.out or "accuracyCost." + os.path.basename(case))
    if options.out.startswith(case + os.sep):
        die("--out %s lies in the case, which is not touched: run it elsewhere" % options.out)
    if options.jobs < 1:
        die("--jobs is %d, allowed: 1 and greater" % options.jobs)
    for given in options.always:
        if not re.fullmatch("[^=]+=[^=]+", given):
            die("--set is '%s', allowed: a name and a value, such as endTime=0.5" % given)
    options.always = [tuple(given.split("=")) for given in options.always]
    knobs = {}
    for vary in options.vary:
        name, _, values = vary.partition("=")
        values = [v for v in values.split(",") if v]
        if not name or len(values) < 2:
            die("--vary is '%s', allowed: a name and two values or more, such as harmonics=8,12,16" % vary)
        if name == "endTime":
            die("endTime says what is looked at, not how exactly: --set endTime=... changes it in all runs")
        if name in knobs:
            die("--vary has %s twice" % name)
        knobs[name] = ordered(name, values)
    if not knobs:
        die("nothing to vary: --vary deltaT=2e-3,1e-3 or --vary cells=24,32,48 (see --help)")
    os.makedirs(options.out, exist_ok=True)
    runs = Runs(options)

    # Coarse and cheap first, the settings in turn
    jobs = [("base", None)] + [
        ("%s=%s" % (name, values[k]), (name, values[k]))
        for k in range(max(map(len, knobs.values()))) for name, values in knobs.items() if k < len(values)]
    results, failures, done = {}, {}, 0

    def one(job):
        try:
            return job, runs.run(*job), None
        except Failed as e:
            return job, None, str(e)

    def report(job, result, failure):
        nonlocal done
        done += 1
        spent = time.time() - runs.started
        text = "%s %.6g, %.1f core s" % (result["quantity"], result["value"], result["seconds"]) \
            if result else "FAILED: " + failure
        print("[%d/%d] %-24s %s; to go some %s" % (
            done, len(jobs), job[0], text, clock(spent / done * (len(jobs) - done))), flush=True)
        (results if result else failures)[job[0]] = result or failure

    runs.endWithSignals()
    # Names and values that no run can take, before the first
    trial = os.path.join(options.out, "runs", "trial")
    for name, values in knobs.items():
        shutil.rmtree(trial, ignore_errors=True)
        copyCase(case, trial)
        try:
            change(trial, name, values[0])
        except Failed as e:
            shutil.rmtree(trial)
            die("%s%s" % (e, "; the time step is deltaT here" if name == "dt" else ""))
    shutil.rmtree(trial)

    report(*one(jobs[0]))
    if "base" in failures:
        die("the case as it stands does not run: " + failures["base"])
    with ThreadPoolExecutor(options.jobs) as pool:
        for outcome in pool.map(one, jobs[1:]):
            report(*outcome)

    # Limits of each setting, then errors
    base, rows, limits = results["base"], [], {}
    sampled = [base]
    for label, r in list(results.items())[1:]:
        try:
            atOneTime(sampled + [r])
            sampled.append(r)
        except Failed as e:
            failures[label] = str(e)
            del results[label]
    atOneTime(sampled)
    for name, values in knobs.items():
        levels = [(v, results["%s=%s" % (name, v)]) for v in values if "%s=%s" % (name, v) in results]
        if len(levels) < 2:
            print("%s: fewer than two of its values ran; no error can be told" % name)
            continue
        limits[name] = (*limitOf(name, [(v, r["value"]) for v, r in levels]), levels)
    if not limits:
        die("no setting has two values that ran")
    best = base["value"] + sum(l[0] - base["value"] for l in limits.values())
    scale = abs(best) or 1
    print("\n%s at time %g: %.6g as the case stands, %.6g estimated without the errors below"
          % (base["quantity"], base["time"], base["value"], best))
    options_ = []
    for name, (limit, sure, how, levels) in limits.items():
        print("    %-12s changes the case's value by %.2g %% up to its limit (%s, sure to %.1g %%)" % (
            name, 100 * abs(base["value"] - limit) / scale, how, 100 * sure / scale))
        choices = [("as it is", abs(base["value"] - limit) / scale, 1.0)]
        for v, r in levels:
            error = abs(r["value"] - limit) / scale
            # The finest is no better than the limit is sure
            error = max(error, sure / scale) if v == levels[-1][0] else error
            rows.append([name, v, r["value"], error, r["seconds"], how])
            choices.append((v, error, r["seconds"] / base["seconds"] if base["seconds"] > 0 else math.nan))
        options_.append([(name, *c) for c in choices])

    with open(options.out + "/accuracyCost.csv", "w") as f:
        table = csv.writer(f)
        table.writerow(["setting", "value", base["quantity"], "error", "coreSeconds", "limitBy"])
        table.writerow(["base", "", base["value"], abs(base["value"] - best) / scale, base["seconds"], ""])
        table.writerows(rows)

    combinations = [(sum(c[2] for c in choice), base["seconds"] * math.prod(c[3] for c in choice), choice)
                    for choice in itertools.product(*options_)]
    for target in (0.01, 0.003, 0.001):
        fit = [c for c in combinations if c[0] <= target]
        if not fit:
            print("For %g %%: none of these; the best reach %.2g %%" % (100 * target, 100 * min(combinations)[0]))
            continue
        error, cost, choice = min(fit, key=lambda c: c[1])
        print("For %g %%: %s, some %.3g core seconds (error %.2g %%)" % (
            100 * target, ", ".join("%s %s" % c[:2] for c in choice), cost, 100 * error))
    draw(options.out + "/accuracyCost.png", base, limits, rows, scale)
    print("Written: %s/accuracyCost.csv and .png" % options.out)
    for label, why in failures.items():
        print("Not run: %s: %s" % (label, why), file=sys.stderr)
    if any("budget" in why for why in failures.values()):
        print("The same command with a larger budget goes on from here", file=sys.stderr)
    sys.exit(2 if failures else 0)


def draw(file, base, limits, rows, scale):
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    figure, axis = plt.subplots(figsize=(7, 5), constrained_layout=True)
    for name, (limit, _, how, levels) in limits.items():
        own = [r for r in rows if r[0] == name and r[3] > 0]
        axis.loglog([r[4] for r in own], [max(r[3], 1e-8) for r in own], "o-", label="%s (%s)" % (name, how))
        for r in own:
            axis.annotate(r[1], (r[4], max(r[3], 1e-8)), textcoords="offset points", xytext=(4, 4), fontsize=8)
    front, least = [], math.inf
    for r in sorted(rows, key=lambda r: r[4]):
        if r[3] < least:
            front.append(r)
            least = r[3]
    axis.loglog([r[4] for r in front], [max(r[3], 1e-8) for r in front], "k:", lw=1, label="nothing is better and cheaper")
    axis.axvline(base["seconds"], color="0.7", lw=1)
    axis.text(base["seconds"], 0.98, "the case as it is ", transform=axis.get_xaxis_transform(), fontsize=8,
              color="0.4", rotation=90, ha="right", va="top")
    axis.set(xlabel="core seconds of the run", ylabel="error of %s from this setting alone" % base["quantity"])
    axis.grid(alpha=0.3)
    axis.legend(fontsize=8, loc="upper left", bbox_to_anchor=(1, 1))
    figure.savefig(file, dpi=100)


if __name__ == "__main__":
    try:
        main()
    except BrokenPipeError:
        os._exit(1)
