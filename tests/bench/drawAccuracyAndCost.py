"""drawAccuracyAndCost.py scenes.txt folder: accuracy-and-cost.{md,csv,png} in it, from
what accuracyCost wrote for each scene (name, title, command)."""
import csv
import os
import sys
import textwrap
from deformablebodies import figures

scenes = [line.rstrip("\n").split("\t") for line in open(sys.argv[1])]
doc = sys.argv[2]


def wrapped(line):
    """The line in lines of at most 120 characters"""
    return textwrap.fill(line, 120, subsequent_indent="        " if line.startswith(" ") else "",
                         break_long_words=False, break_on_hyphens=False)


figure, axes = figures.columns(3, width=4, rows=3)
text = ["""# What accuracy costs

Made by `tests/bench/accuracyAndCost`, which runs `bin/accuracyCost` on tutorials with other settings; your own case
takes the same command. The error of each setting that is varied is the difference between the quantity at the end and
the setting's own limit (Richardson's value or the finest, as written; that of the finest, hollow in the picture, is how
sure the limit is; lines join what no cheaper value reaches). Errors of different settings add up. Core seconds are
those of the run on one core of a busy machine (below a second the least of three runs): compare them with each other.
What no mesh shows is not in it: at a viscosity ratio of 5 boundary integrals have 0.202, 5 % less.

Errors of the cells against values that no mesh has touched, boundary integrals, are in [accuracy.csv](accuracy.csv) and
in the picture of the README (`tests/bench/accuracy`). The error that a run states of itself, in its log and for
`accuracy 0.01;`, follows laws that cover these curves and their scatter; they stand in the function `errors()` of each
kind of body. On other scenes the true error is within the stated one (`tests/validation/expectedErrors`).

![Error against core seconds](accuracy-and-cost.png)
"""]
rows = []
for (name, title, command), axis in zip(scenes, axes.flat):
    own = list(csv.reader(open(name + "/accuracyCost.csv")))
    quantity, own = own[0][2], own[1:]
    figures.errorsAgainstSeconds(axis, [r for r in own if r[0] != "base"], float(own[0][4]), 100, 7)
    axis.set_title(title.replace("Ca_G", "$Ca_G$"), pad=20)
    axis.set(xlabel="core seconds", ylabel="error of %s [%%]" % quantity)
    axis.margins(0.13)
    axis.legend(loc="lower center", bbox_to_anchor=(0.5, 0.98), ncol=5, handletextpad=0, columnspacing=0.8)
    rows += [[name, quantity, *r] for r in own]
    told = [line.rstrip() for line in open(name + ".log") if not line.startswith(("[", "Written"))]
    text.append("## %s\n\n%s\n\n```\n%s\n```\n" % (title, wrapped("`%s`" % command),
                                                    "\n".join(map(wrapped, told)).strip()))
for axis in axes.flat[len(scenes):]:
    axis.axis("off")
figures.save(figure, doc + "/accuracy-and-cost.png", dpi=85)
with open(doc + "/accuracy-and-cost.csv", "w") as f:
    out = csv.writer(f, lineterminator="\n")
    out.writerow(["scene", "quantity", "setting", "value", "result", "error", "coreSeconds", "limitBy"])
    out.writerows(rows)
open(doc + "/accuracy-and-cost.md", "w").write("\n".join(text))
