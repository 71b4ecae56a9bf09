"""Figure of the study of fibres that settle: drawSettling.py table.csv picture.png"""
import csv
import sys
import matplotlib
matplotlib.use("Agg")
import matplotlib.pyplot as plt

rows = list(csv.DictReader(open(sys.argv[1])))
panels = (("velocity", "mean velocity/that of one alone"), ("clustering", "variance of the neighbours/their mean"),
          ("deviation", "deviation of the velocity/that of one alone"), ("beside", "pairs beside each other/at random"))
figure, axes = plt.subplots(1, 4, figsize=(14, 3.6), constrained_layout=True)
for stiffness, colour in (("1", "#440154"), ("0.01", "#35b779")):
    for wide, mark in ((False, "o-"), (True, "s")):
        some = sorted((r for r in rows if r["point"].startswith(stiffness + ".") and r["point"].endswith("wide") == wide),
                      key=lambda r: float(r["fraction"]))
        for axis, (name, _) in zip(axes, panels):
            bars = [max(float(r["error"]), 0) for r in some] if name == "velocity" else None
            axis.errorbar([100 * float(r["fraction"]) for r in some], [float(r[name]) for r in some], bars, fmt=mark,
                          color=colour, ms=5, mfc="none" if wide else colour, capsize=3, lw=1.2,
                          label="stiffness %s%s" % (stiffness, ", wider box" if wide else ""))
for axis, (name, text) in zip(axes, panels):
    axis.axhline(0 if name == "deviation" else 1, color="0.6", lw=0.8)
    axis.set(xlabel="volume [%]", ylabel=text, xlim=(0, None))
    axis.grid(alpha=0.3)
axes[0].legend(fontsize=8)
figure.savefig(sys.argv[2], dpi=100)
