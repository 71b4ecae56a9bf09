"""drawAccuracyAndCost.py scenes.txt doc: doc/accuracy-and-cost.{md,csv,png} from what
accuracyCost wrote for each scene (name, title, command)."""
import csv
import sys
import matplotlib
matplotlib.use("Agg")
import matplotlib.pyplot as plt
from matplotlib import ticker

scenes = [line.rstrip("\n").split("\t") for line in open(sys.argv[1])]
doc = sys.argv[2]
figure, axes = plt.subplots(3, 3, figsize=(15, 12), constrained_layout=True)
text = ["""# What accuracy costs

Made by `tests/bench/accuracyAndCost`, which runs `bin/accuracyCost` on tutorials with other settings; your own case takes the same command. Of each setting that is varied the error is what the
quantity at the end differs from the setting's own limit (Richardson's value or the finest, as written; that of the finest, hollow in the picture, is how sure the limit is). Errors of different settings add up. Core seconds are those of the run on one core of a busy
machine (below a second the least of three runs): compare them with each other.

Errors of the cells against values that no mesh has touched, boundary integrals, are in [accuracy.csv](accuracy.csv) and in the picture of the README (`tests/bench/accuracy`). What a run
states of its own error, in its log and for `accuracy 0.01;`, follows laws that cover these curves and their scatter; they stand in one place each, of capsules
[capsuleErrors.C](../src/deformableBodies/capsules/capsuleErrors.C), of filaments [filamentShape.C](../src/deformableBodies/filaments/filamentShape.C), of rigid bodies
[rigidMotion.C](../src/deformableBodies/rigidBodies/rigidMotion.C) (`errors()`). On other scenes the true error is within the stated one (`tests/validation/expectedErrors`).

![Error against core seconds](accuracy-and-cost.png)
"""]
rows = []
for (name, title, command), axis in zip(scenes, axes.flat):
    own = list(csv.reader(open(name + "/accuracyCost.csv")))
    quantity, own = own[0][2], own[1:]
    for setting in dict.fromkeys(r[0] for r in own if r[0] != "base"):
        finest = [r for r in own if r[0] == setting][-1]
        mine = [r for r in own if r[0] == setting and float(r[3]) > 0]
        x, y = [float(r[4]) for r in mine], [max(1e2 * float(r[3]), 1e-4) for r in mine]
        line, = axis.loglog(x, y, "o-", label=setting, markersize=4)
        if mine and mine[-1] is finest and not finest[5].startswith("taken"):
            axis.plot(x[-1:], y[-1:], "o", color=line.get_color(), mfc="white", markersize=4)
        for r, a, b in zip(mine, x, y):
            axis.annotate(r[1], (a, b), textcoords="offset points", xytext=(3, 3), fontsize=7)
    axis.axvline(float(own[0][4]), color="0.8", lw=1, zorder=0)
    axis.set(title=title, xlabel="core seconds", ylabel="error of %s [%%]" % quantity)
    for part in (axis.xaxis, axis.yaxis):
        part.set_major_locator(ticker.LogLocator(subs=(1, 2, 5)))
        part.set_major_formatter("{x:g}")
        part.set_minor_formatter(ticker.NullFormatter())
    axis.grid(alpha=0.3)
    axis.legend(fontsize=8)
    rows += [[name, quantity, *r] for r in own]
    told = [line.rstrip() for line in open(name + ".log") if not line.startswith(("[", "Written"))]
    text.append("## %s\n\n`%s`\n\n```\n%s\n```\n" % (title, command, "\n".join(told).strip()))
for axis in axes.flat[len(scenes):]:
    axis.axis("off")
figure.savefig(doc + "/accuracy-and-cost.png", dpi=65)
with open(doc + "/accuracy-and-cost.csv", "w") as f:
    out = csv.writer(f, lineterminator="\n")
    out.writerow(["scene", "quantity", "setting", "value", "result", "error", "coreSeconds", "limitBy"])
    out.writerows(rows)
open(doc + "/accuracy-and-cost.md", "w").write("\n".join(text))
