"""drawAccuracyAndCost.py scenes.txt doc: doc/accuracy-and-cost.{md,csv,png} from what
accuracyCost wrote for each scene (name, title, command)."""
import csv
import sys
import matplotlib
matplotlib.use("Agg")
import matplotlib.pyplot as plt

scenes = [line.rstrip("\n").split("\t") for line in open(sys.argv[1])]
doc = sys.argv[2]
figure, axes = plt.subplots(3, 3, figsize=(15, 12), constrained_layout=True)
text = ["""# What accuracy costs

Made by `tests/bench/accuracyAndCost`, which runs `bin/accuracyCost` on tutorials with other settings; your own case takes the same command. Of each setting that is varied the error is what the
quantity at the end differs from the setting's own limit (Richardson's value or the finest, as written; that of the finest, hollow in the picture, is how sure the limit is). Errors of different settings add up. Core seconds are those of the run on one core of a busy
machine: compare them with each other.

Errors of the cells against values that no mesh has touched, boundary integrals, are in [accuracy.csv](accuracy.csv) and in the picture of the README (`tests/bench/accuracy`); what a run
states of its own error (`accuracy 0.01;`) follows these laws, with their scatter as margin ([capsuleErrors.C](../src/deformableBodies/capsules/capsuleErrors.C)):

| source | relative error of D |
|---|---|
| cells, with near field, a/h 3 and more | 0.3 % (0.7 % with a viscosity ratio) |
| cells, without, spheres | 11.5 % (4 h/a)^1.3 |
| harmonics to degree N | 0.3 % (6/N)^2, below 5: 1.5 % |
| markers s cells apart, stretched by a quarter, s from 0.9 to 1.6 | 0.03 % s^6 |
| step | 6 (deltaT rate)^2 |

On other scenes the true error is within the stated one (`tests/validation/expectedErrors`). Of filaments: 4/segments^2 of the shape, and 3 % of the drag of a fibre of the kernel's
thickness; of rigid spheres 0.3 % (3 h/a)^2 of the drag with near field, 6.4 % h/a without; of both 0.08 % nu deltaT/h^2, up to 10 and once steady. `pimple` adds 1 %.

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
