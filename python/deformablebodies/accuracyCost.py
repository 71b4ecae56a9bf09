"""Accuracy of a case against its cost.

Runs copies of a case (the case itself is not touched), each with one setting changed, and
compares a quantity of the bodies at the end. The error of a value of a setting is its
difference from the limit of this setting: Richardson's extrapolation if the three finest
values converge with a steady order, otherwise the finest value. The output folder gets a
table (accuracyCost.csv) and a picture (accuracyCost.png: error against core seconds, a line
for each setting, the cheapest marked); the cheapest combinations for 1, 0.3 and 0.1 % are
printed. Errors of different settings are added, costs multiplied. Core seconds of a run
below one second are the least of three.

For settings that are words (nearField, kernel, ...) the last value is taken to be right. The
case's own value is compared only if it is among those given. Each run starts from 0.orig if
the case has it, otherwise from 0, after blockMesh and setExprFields if the case has their
dictionaries. Finished runs are kept: the same command continues after an interruption.

    accuracyCost tutorials/capsule/shear --vary cells=24,32,48 --vary harmonics=8,12,16
    accuracyCost mine --vary deltaT=2e-3,1e-3,5e-4 --quantity inclination --budget 30min

Settings that can be varied, coarse values first or in any order:
    any entry of constant/scene, where the case has that file (dt, cells, ...)
    cells           along the first direction of blockMeshDict, the others in proportion
    deltaT, maxCo                              in system/controlDict
    kernel, accuracy                           in constant/deformableBodies
    harmonics, markerSpacing, nearField, motion, segments, scheme
                                               in each group that may have them
    <file>:<entry>  any other, such as system/fvSolution:PIMPLE/diffusion=ADI,FFT
"""
import csv
import itertools
import math
import os
import shutil
import sys
import time
from concurrent.futures import ThreadPoolExecutor
from .runs import Failed, NotOfTheCase, OutOfTime, Runs, atOneTime, change, clock, copyCase, die, guarded, percent, readOptions

# Settings of which larger values are finer, and smaller ones; other settings are compared
# with the last value given
finerUp = {"cells", "harmonics", "segments"}
finerDown = {"deltaT", "dt", "maxCo", "markerSpacing", "maxDeltaT"}
words = {"nearField": ["off", "auto", "on"], "accuracy": ["draft", "standard", "reference"]}


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
    """Limit of a setting, its uncertainty, and how it was found.
    levels: (setting, value of the quantity), coarse to fine."""
    fine = levels[-1][1]
    if name not in finerUp | finerDown:
        return fine, 0.0, "taken to be right: the last"
    numbers = [number(v) for v, _ in levels]
    if len(levels) < 2:
        return fine, math.nan, "one value only"
    # Two values that agree by chance are no more certain than the third shows
    change = max([abs(fine - levels[-2][1])] + [abs(levels[-2][1] - l[1]) / 4 for l in levels[-3:-2]])
    if len(levels) >= 3 and None not in numbers:
        h = [x if name in finerDown else 1 / x for x in numbers[-3:]]
        d1, d2 = levels[-3][1] - levels[-2][1], levels[-2][1] - fine
        if d2 != 0 and d1 / d2 > 1:
            # d1/d2 = (h0^p - h1^p)/(h1^p - h2^p) by bisection. An order above that of all
            # methods is chance, or due to a first value that is too coarse
            f = lambda p: (h[0]**p - h[1]**p) / (h[1]**p - h[2]**p) - d1 / d2
            low, high = 0.3, 3.0
            if f(high) <= 0:
                # Uncertainty as for second order
                return fine, abs(d1) * h[2]**2 / (h[0]**2 - h[1]**2), "the finest, order 3 or more"
            if f(low) < 0:
                for _ in range(80):
                    middle = 0.5 * (low + high)
                    low, high = (middle, high) if f(middle) < 0 else (low, middle)
                p = 0.5 * (low + high)
                limit = fine - d2 * h[2]**p / (h[1]**p - h[2]**p)
                return limit, abs(limit - fine), "Richardson, order %.1f" % p
    return fine, change, "the finest"


def addOptions(parser):
    parser.add_argument("--vary", action="append", default=[], metavar="NAME=V1,V2,...",
                        help="a setting and its values; may be given several times")
    parser.add_argument("--jobs", type=int, default=1, help="runs side by side (default 1: side by side "
                        "they share the memory, and take more core seconds)")


def main():
    options = readOptions("accuracyCost", __doc__, addOptions)
    case = options.case
    if options.jobs < 1:
        die("--jobs is %d, allowed: 1 and greater" % options.jobs)
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
        for v in values if name in finerUp | finerDown else []:
            x = number(v)
            if x is None or not 0 < x < math.inf or (name in finerUp and x != int(x)):
                die("--vary %s has '%s', allowed: %s numbers greater than 0" % (
                    name, v, "whole" if name in finerUp else "only"))
        knobs[name] = ordered(name, values)
    if not knobs:
        die("nothing to vary: --vary deltaT=2e-3,1e-3 or --vary cells=24,32,48 (see --help)")
    os.makedirs(options.out, exist_ok=True)
    runs = Runs(options)

    # Coarse and cheap runs first, the settings in turn
    jobs = [("base", [])] + [
        ("%s=%s" % (name, values[k]), [(name, values[k])])
        for k in range(max(map(len, knobs.values()))) for name, values in knobs.items() if k < len(values)]
    results, failures, done = {}, {}, 0

    def one(job):
        try:
            return job, runs.run(*job), None
        except Failed as e:
            return job, None, e

    def report(job, result, failure):
        nonlocal done
        done += 1
        spent = time.time() - runs.started
        text = "%s %.6g, %.1f core s" % (result["quantity"], result["value"], result["seconds"]) \
            if result else "FAILED: %s" % failure
        if result or done > 1:
            text += "; to go some " + clock(spent / done * (len(jobs) - done))
        print("[%d/%d] %-24s %s" % (done, len(jobs), job[0], text), flush=True)
        (results if result else failures)[job[0]] = result or failure

    runs.endWithSignals()
    # Check names and values before the first run
    trial = os.path.join(options.out, "runs", "trial")
    for name, values in knobs.items():
        shutil.rmtree(trial, ignore_errors=True)
        for value in values:
            copyCase(case, trial)
            try:
                change(trial, name, value)
            except Failed as e:
                die("%s%s" % (e, "; the time step is deltaT here" if name == "dt" else ""))
            finally:
                shutil.rmtree(trial)

    report(*one(jobs[0]))
    if "base" in failures:
        why = failures["base"]
        die(why if isinstance(why, NotOfTheCase) else "the case as it stands does not run: %s" % why)
    runs.quantity = results["base"]["quantity"]
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
            failures[label] = e
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
        print("    %-12s changes the case's value by %s up to its limit (%s, sure to %s)" % (
            name, percent(abs(base["value"] - limit) / scale), how, percent(sure / scale)))
        # Errors are at least the uncertainty of the limit
        errorOf = lambda value: max(abs(value - limit), sure) / scale
        choices = [("as it is", errorOf(base["value"]), 1.0)]
        for v, r in levels:
            error = errorOf(r["value"])
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
            print("For %g %%: none of these; the best reach %s" % (100 * target, percent(min(combinations)[0])))
            continue
        error, cost, choice = min(fit, key=lambda c: c[1])
        print("For %g %%: %s, some %.3g core seconds (error %s)" % (
            100 * target, ", ".join("%s %s" % c[:2] for c in choice), cost, percent(error)))
    draw(options.out + "/accuracyCost.png", base, rows)
    print("Written: %s/accuracyCost.csv and .png" % options.out)
    for label, why in failures.items():
        print("Not run: %s: %s" % (label, why), file=sys.stderr)
    if any(isinstance(why, OutOfTime) for why in failures.values()):
        print("The same command with a larger budget goes on from here", file=sys.stderr)
    sys.exit(2 if failures else 0)


def draw(file, base, rows):
    from . import figures
    figure, axis = figures.columns(1, 4.5, 6.2)
    figures.errorsAgainstSeconds(axis, rows, base["seconds"], 1, 8, "{setting} ({how})")
    front, least = [], math.inf
    for r in sorted(rows, key=lambda r: r[4]):
        if r[3] < least:
            front.append(r)
            least = r[3]
    axis.plot([r[4] for r in front], [max(r[3], 1e-8) for r in front], "k:", lw=1, label="nothing is better and cheaper")
    axis.text(base["seconds"], 0.98, "the case as it is ", transform=axis.get_xaxis_transform(), fontsize=8,
              color="0.4", rotation=90, ha="right", va="top")
    axis.set(xlabel="core seconds of the run", ylabel="error of %s from this setting alone" % base["quantity"])
    axis.margins(0.08)
    axis.legend(loc="upper left", bbox_to_anchor=(1, 1), title_fontsize=8,
                title="hollow: the finest value,\nits error is how sure the limit is")
    figures.save(figure, file)


if __name__ == "__main__":
    guarded(main)
