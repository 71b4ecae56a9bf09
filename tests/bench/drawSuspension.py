"""drawSuspension.py suspension.csv folder: suspension.csv and suspension.png in it"""
import csv
import shutil
import sys
from deformablebodies import figures

rows = list(csv.DictReader(open(sys.argv[1])))
figure, axes = figures.columns(2, 3.6, 4.4)
for kind, mark, colour, label in (("capsules", "o-", figures.blue, "capsules, 30 %"),
                                  ("fibres", "s-", figures.orange, "fibres, $nL^3$ = 1"),
                                  ("capsulesInOneBox", "o--", figures.blue, "capsules in $96^3$ cells"),
                                  ("fibresInOneBox", "s--", figures.orange, "fibres in $128^3$ cells")):
    own = [r for r in rows if r["kind"] == kind and r["number"] != "0"]
    n = [int(r["number"]) for r in own]
    look = {"color": colour, "mfc": "white" if "--" in mark else colour, "label": label}
    axes[0].loglog(n, [float(r["msPerStep"]) for r in own], mark, **look)
    axes[1].semilogx(n, [100 * float(r["interactions"]) for r in own], mark, **look)
first = next(r for r in rows if r["kind"] == "capsules" and r["number"] == "64")
axes[0].loglog([1, 5000], [float(first["msPerStep"]) / 64 * x for x in (1, 5000)], "k:", lw=1, label="proportional")
axes[0].set(xlabel="number of bodies", ylabel="ms of a step, the flow included")
axes[1].set(xlabel="number of bodies", ylabel="share of the interactions [%]", ylim=(0, None))
axes[1].legend(*axes[0].get_legend_handles_labels(), loc="upper left")
figures.save(figure, sys.argv[2] + "/suspension.png")
shutil.copy(sys.argv[1], sys.argv[2] + "/suspension.csv")
