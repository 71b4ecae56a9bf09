"""Figure of the study of fibres that settle: drawSettling.py table.csv picture.png. V_1 is the velocity
of one alone; the table has errors of the mean velocity only."""
import sys
from deformablebodies import figures
from deformablebodies.tables import records

rows = records(sys.argv[1])
panels = (("velocity", r"mean velocity $\langle V\rangle/V_1$"),
          ("clustering", "variance/mean of the neighbours"), ("deviation", r"deviation of the velocity/$V_1$"))
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
lines = [axes[0].axhline(1, **figures.theory, label="one alone"),
         axes[1].axhline(float(rows[0]["random"]), **figures.theory, label="centres at random, %.2f" % float(rows[0]["random"]))]
for axis, (_, text) in zip(axes, panels):
    axis.set(xlabel="volume fraction [%]", ylabel=text, xlim=(0, None))
for axis, line in zip(axes, lines):
    axis.margins(y=0.2)
    axis.legend(handles=[line], loc="upper right")
axes[2].margins(y=0.1)
axes[2].set_ylim(0, None)
axes[2].legend(loc="lower right")
figures.save(figure, sys.argv[2])
