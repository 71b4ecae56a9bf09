"""Figure of the study of fibres that settle: drawSettling.py table.csv picture.png"""
import sys
from deformablebodies import figures
from deformablebodies.tables import records

rows = records(sys.argv[1])
panels = (("velocity", "mean velocity/that of one alone"), ("clustering", "variance of the neighbours/their mean"),
          ("deviation", "deviation of the velocity/that of one alone"))
figure, axes = figures.columns(3, width=3.5)
for stiffness, colour in (("1", figures.black), ("0.01", figures.blue)):
    for wide, mark in ((False, "o-"), (True, "s")):
        some = sorted((r for r in rows if r["point"].startswith(stiffness + ".") and r["point"].endswith("wide") == wide),
                      key=lambda r: float(r["fraction"]))
        for axis, (name, _) in zip(axes, panels) if some else ():
            bars = [max(float(r["error"]), 0) for r in some] if name == "velocity" else None
            axis.errorbar([100 * float(r["fraction"]) for r in some], [float(r[name]) for r in some], bars, fmt=mark,
                          color=colour, ms=5, mfc="none" if wide else colour,
                          label="stiffness %s%s" % (stiffness, ", wider box" if wide else ""))
for axis, (name, text) in zip(axes, panels):
    axis.axhline(0 if name == "deviation" else 1, color="0.6", lw=0.8)
    axis.set(xlabel="volume [%]", ylabel=text, xlim=(0, None))
axes[0].legend()
figures.save(figure, sys.argv[2])
