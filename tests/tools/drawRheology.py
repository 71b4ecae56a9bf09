"""Figure of the study of suspensions: drawRheology.py table.csv picture.png"""
import csv
import re
import sys
import matplotlib
matplotlib.use("Agg")
import matplotlib.pyplot as plt


def of(row, *names):
    return [float(row[n]) for n in names]


rows = list(csv.DictReader(open(sys.argv[1])))
capsules, fibres = [], []
for r in rows:
    name = r["point"]
    Re = re.search(r"Re(0\.1|10|1)\.", name)[1]
    if name.startswith("capsules"):
        capsules.append((Re, "rigid" in name, float(re.search(r"Ca(\d+\.\d)", name)[1]), r))
    else:
        fibres.append((Re, float(r["fraction"]), float(name.split("B")[1]), r))
figure, axes = plt.subplots(2, 3, figsize=(13, 7.4), constrained_layout=True)
columns = (("viscosity", "error", "relative viscosity"), ("N1", "N1error", "N1/(mu rate)"), ("N2", "N2error", "N2/(mu rate)"))
for axis, (value, error, text) in zip(axes[0], columns):
    for Re in sorted({c[0] for c in capsules}, key=float):
        for nucleus in (False, True):
            for Ca in sorted({c[2] for c in capsules}):
                line = sorted(of(r, "fraction", value, error) for a, b, c, r in capsules if (a, b, c) == (Re, nucleus, Ca))
                if line:
                    x, y, e = zip(*line)
                    axis.errorbar(x, y, [max(v, 0) for v in e], fmt="s--" if nucleus else "o-", ms=4, capsize=2, lw=1,
                                  label=f"Re {Re}, Ca {Ca:g}" + (", rigid nuclei" if nucleus else ""))
    axis.set(xlabel="volume fraction of capsules", ylabel=text)
for axis, (value, error, text) in zip(axes[1], columns):
    for Re in sorted({f[0] for f in fibres}, key=float):
        for nL3 in sorted({f[1] for f in fibres}):
            line = sorted([B, *of(r, value, error)] for a, n, B, r in fibres if (a, n) == (Re, nL3))
            if line:
                x, y, e = zip(*line)
                axis.errorbar(x, y, [max(v, 0) for v in e], fmt="o-", ms=4, capsize=2, lw=1, label=f"Re {Re}, n L^3 {nL3:g}")
    axis.set(xlabel="B/(mu rate L^4) of fibres", ylabel=text, xscale="log")
for axis in axes.flat:
    axis.grid(alpha=0.3)
    if axis.get_legend_handles_labels()[0]:
        axis.legend(fontsize=7)
figure.savefig(sys.argv[2], dpi=110)
