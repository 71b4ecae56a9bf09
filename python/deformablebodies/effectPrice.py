"""Cost of each effect of a case, and the change of the result without it.

Runs a copy of the case as it stands, reads the table of effects from its log, and then
runs copies without one effect at a time (the case itself is not touched). For each effect
it prints, and writes to <out>/effectPrice.csv: seconds of a step by the timers of the run,
seconds by which a run without the effect is shorter, and the change of a quantity of the
bodies at the end. Finished runs are kept: the same command continues after an interruption.

    effectPrice tutorials/capsule/nucleated
    effectPrice mine --quantity inclination --budget 30min
"""
import csv
import os
import re
import sys
import textwrap
from .runs import Failed, NotOfTheCase, OutOfTime, Runs, atOneTime, dictionary, die, guarded, percent, readOptions

bodiesFile = "constant/deformableBodies"


def keys(folder, file, entry=None):
    path = os.path.join(folder, file)
    if not os.path.isfile(path):
        return []
    return (dictionary(path, *(["-entry", entry] if entry else []), "-keywords") or "").split()


def value(folder, file, entry):
    return (dictionary(os.path.join(folder, file), "-entry", entry, "-value") or "").strip()


def ways(folder):
    """Effects that can be left out: name in the table of the log, name here, changes."""
    found = []
    for group in keys(folder, bodiesFile, "bodies"):
        at = "bodies/" + group
        own = keys(folder, bodiesFile, at)
        type_ = value(folder, bodiesFile, at + "/type")
        for entry, effect in (("bending", "bending"), ("viscosityRatio", "viscosityRatio"),
                              ("gravity", "gravity"), ("nucleus", "nucleus"), ("baseMotion", "filament")):
            if entry in own:
                found.append((effect, "%s of %s" % (entry, group), [("%s:%s/%s" % (bodiesFile, at, entry), None)] + (
                    [("%s:%s/densityRatio" % (bodiesFile, at), None)]
                    if entry == "gravity" and type_ == "capsule" else [])))
        if type_ in ("capsule", "rigid"):
            found.append(("nearField", "near field of " + group, [("%s:%s/nearField" % (bodiesFile, at), "off")]))
        if type_ == "capsule":
            found.append(("stabilised", "stabilised motion of " + group,
                          [("%s:%s/motion" % (bodiesFile, at), "explicit")]))
        if type_ == "filament":
            found.append(("thicknessCouple", "couple of the thickness of " + group,
                          [("%s:%s/thicknessCouple" % (bodiesFile, at), "off")]))
        if type_ in ("capsule", "filament"):
            found.append(("spreading", "feedback of %s on the fluid" % group,
                          [("%s:%s/coupling" % (bodiesFile, at), "oneWay")]))
    for kind in ("interactions", "loads"):
        for name in keys(folder, bodiesFile, kind) if kind in keys(folder, bodiesFile) else []:
            found.append((name if kind == "interactions" else "", "%s %s" % (kind[:-1], name),
                          [("%s:%s/%s" % (bodiesFile, kind, name), None)]))
    if value(folder, "system/fvSolution", "PIMPLE/convection") not in ("off", "no", "false"):
        found.append(("momentum", "convection", [("system/fvSolution:PIMPLE/convection", "off")]))
    for name in keys(folder, "constant/fvOptions"):
        if (name != "FoamFile" and value(folder, "constant/fvOptions", name + "/type") != "deformableBodies" and
                value(folder, "constant/fvOptions", name + "/active") not in ("off", "no", "false")):
            found.append(("sources", "source " + name, [("constant/fvOptions:%s/active" % name, "no")]))
    return found


def table(log):
    """Names of the active and of the skipped effects, from the log."""
    block = re.search(r"Effects of this scene\n(.*?)\n\n", open(log).read(), re.S)
    if not block:
        raise Failed("the log has no table of effects: does the case have bodies?")
    rows = [line.split(None, 2) for line in block[1].splitlines()]
    return tuple([r[0] for r in rows if r[1] == word] for word in ("active", "skipped"))


def clocks(log):
    """Seconds of each effect in the whole run, from the log."""
    block = re.search(r"Seconds per effect[^\n]*\n(.*?)\n\n", open(log).read(), re.S)
    rows = (line.split() for line in block[1].splitlines()) if block else ()
    return {r[0]: float(r[1]) for r in rows if len(r) > 2 and r[2][-1].isdigit()}


def main():
    options = readOptions("effectPrice", __doc__)
    os.makedirs(options.out, exist_ok=True)
    runs = Runs(options)
    runs.endWithSignals()

    folder = os.path.join(options.out, "runs", "base")
    try:
        base = runs.run("base", [])
        log = os.path.join(folder, "log." + (dictionary(
            folder + "/system/controlDict", "-entry", "application", "-value") or "").strip())
        active, skipped = table(log)
    except Failed as e:
        die(str(e) if isinstance(e, NotOfTheCase) else "the case as it stands does not run: %s" % e)
    runs.quantity = base["quantity"]
    spent = clocks(log)
    print("%s at time %g: %.6g, %.1f core s" % (base["quantity"], base["time"], base["value"], base["seconds"]))
    print("Seconds by the clocks of the run: " + ", ".join(
        "%s %.2f" % s for s in sorted(spent.items(), key=lambda s: -s[1]) if s[1] >= 0.005 * base["seconds"]))
    todo = [w for w in ways(folder) if not w[0] or w[0] in active]
    print("Skipped, free: " + ", ".join(skipped) + "\n")

    print("%-40s %8s %8s %12s  %s changes" % ("without", "core s", "less by", "its clock", base["quantity"]))
    rows, failed, notRun = [], 0, ""
    for n, (effect, name, changes) in enumerate(todo):
        try:
            b, r = atOneTime([dict(base), runs.run("without " + name, changes)])
        except OutOfTime as e:
            notRun = ", ".join(name for _, name, _ in todo[n:])
            print("Not run, %s: %s\nThe same command with a larger budget goes on from here" % (e, notRun), file=sys.stderr)
            break
        except Failed as e:
            failed += 1
            print("%-40s cannot be left out: %s" % (name, textwrap.shorten(str(e), 300)), flush=True)
            continue
        cost = (base["seconds"] - r["seconds"]) / base["seconds"]
        change = (r["value"] - b["value"]) / (abs(b["value"]) or 1)
        rows.append([name, spent.get(effect, ""), r["seconds"], cost, r["value"], change])
        own = spent.get(effect)
        print("%-40s %8.1f %8s %12s  %s   [%d/%d]" % (
            name, r["seconds"], "-" if base["seconds"] < 1 else "%.0f %%" % (100 * cost),
            "-" if own is None else "%.0f %%" % (100 * own / max(1e-9, sum(spent.values()))),
            percent(change), n + 1, len(todo)), flush=True)
    with open(options.out + "/effectPrice.csv", "w") as f:
        lines = csv.writer(f)
        lines.writerow(["without", "clockSeconds", "coreSeconds", "shareOfCost", base["quantity"], "change"])
        lines.writerow(["nothing", "", base["seconds"], 0, base["value"], 0])
        lines.writerows(rows)
    if base["seconds"] < 10:
        print("Short runs: what the run without an effect is shorter by, is known to tens of per cent only")
    small = [r for r in rows if r[1] and r[1] > 0.02 * sum(spent.values()) and abs(r[5]) < 1e-3]
    if small:
        print("\nCosts more than 2 % and changes less than 0.1 % by then: " + ", ".join(r[0] for r in small))
    print("Written: %s/effectPrice.csv" % options.out)
    sys.exit(2 if notRun or (failed == len(todo) and todo) else 0)


if __name__ == "__main__":
    guarded(main)
