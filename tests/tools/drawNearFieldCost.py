"""What the near field between bodies is worth: error over core-seconds with and without.

    drawNearFieldCost.py picture.png pairs.csv [dense.csv]
"""
import os
import sys
from deformablebodies import figures
from deformablebodies.tables import records

pairs = records(sys.argv[2])
dense = records(sys.argv[3]) if len(sys.argv) > 3 and os.path.exists(sys.argv[3]) else []
figure, axes = figures.columns(2 if dense else 1)
axes = list(axes) if dense else [axes]
for between, style in (("on", "o-"), ("off", "s--")):
    some = [r for r in pairs if r["nearField"] == between]
    axes[0].loglog([float(r["seconds"]) for r in some], [float(r["y"]) for r in some], style,
                   label="near field between bodies " + between)
    for r in some:
        axes[0].annotate("a/h %s" % r["cells"], (float(r["seconds"]), float(r["y"])), xytext=(4, 4),
                         textcoords="offset points", fontsize=7)
    for box, colour in zip(dict.fromkeys(r["box"] for r in dense), (figures.black, figures.blue, figures.orange)):
        own = [r for r in dense if r["box"] == box and r["nearField"] == between]
        if not own:
            continue
        axes[1].semilogx([float(r["seconds"]) for r in own], [float(r["viscosity"]) for r in own], style, color=colour,
                         mfc=colour if between == "on" else "none", label=box + ("" if between == "on" else ", off"))
axes[0].set(xlabel="core-seconds", ylabel="largest error of y [a]", title="two capsules that pass, Ca$_G$ 0.3")
if dense:
    axes[1].set(xlabel="core-seconds", ylabel="relative viscosity", title="64 bodies, 30 % (spheres 20 %)")
    axes[1].legend(ncol=2, loc="center right", bbox_to_anchor=(1, 0.75))
axes[0].legend()
figures.save(figure, sys.argv[1])
