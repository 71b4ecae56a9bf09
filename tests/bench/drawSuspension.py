"""drawSuspension.py suspension.csv folder: suspension.csv and suspension.png in it"""
import csv
import shutil
import sys
from deformablebodies.figures import plt

rows = list(csv.DictReader(open(sys.argv[1])))
figure, axes = plt.subplots(1, 2, figsize=(12, 4), constrained_layout=True)
for kind, mark, label in (("capsules", "C0o-", "capsules, 30 %"), ("fibres", "C1s-", "fibres, n L$^3$ = 1"),
                          ("capsulesInOneBox", "C0o--", "capsules in a box of 96$^3$ cells"),
                          ("fibresInOneBox", "C1s--", "fibres in one of 128$^3$")):
    own = [r for r in rows if r["kind"] == kind and r["number"] != "0"]
    n = [int(r["number"]) for r in own]
    axes[0].loglog(n, [float(r["msPerStep"]) for r in own], mark, label=label)
    axes[1].semilogx(n, [100 * float(r["interactions"]) for r in own], mark, label=label)
first = next(r for r in rows if r["kind"] == "capsules" and r["number"] == "64")
axes[0].loglog([1, 5000], [float(first["msPerStep"]) / 64 * x for x in (1, 5000)], "k:", lw=1, label="proportional")
axes[0].set(xlabel="number of bodies", ylabel="ms of a step, the flow included")
axes[1].set(xlabel="number of bodies", ylabel="share of the interactions [%]", ylim=(0, None))
for a in axes:
    a.grid(alpha=0.3)
axes[1].legend(*axes[0].get_legend_handles_labels(), loc="upper left", bbox_to_anchor=(1, 1))
figure.savefig(sys.argv[2] + "/suspension.png", dpi=80)
shutil.copy(sys.argv[1], sys.argv[2] + "/suspension.csv")
