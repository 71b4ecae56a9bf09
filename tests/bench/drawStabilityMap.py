"""drawStabilityMap.py stabilityMap.csv stabilityMap.png: maps of time steps, a row of panels each"""
import sys
from matplotlib.patches import Patch, Rectangle
from matplotlib.lines import Line2D
from deformablebodies import figures
from deformablebodies.tables import records

colours = {"accurate": "#74add1", "fair": "#fee090", "off": "#f46d43", "stopped": "#555555", "noReference": "white"}
labels = {"accurate": "error below 1 %", "fair": "below 10 %", "off": "more, or warned of", "stopped": "stopped"}
maps = {"stiffness": "$Ca_G$", "bending": "$E_B/(a^2 G_s)$\n$Ca_G$ = 0.05", "viscosity": "viscosity ratio\n$Ca_G$ = 0.15",
        "area": "Skalak's $C$\n$Ca_G$ = 0.15", "inertia": "Re\n$Ca_G$ = 0.05",
        "density": "density ratio of a\nrigid ellipsoid, Re = 0.1"}
titles = {"default": "default", "explicit": "motion explicit; maxRetries 0;", "penalty": "motion penalty; maxRetries 0; (two smaller steps)",
          "once": "maxRetries 0;"}


def text(row):
    """Error in per cent"""
    if row["verdict"] == "stopped":
        return ""
    error = 100 * float(row["error"])
    return "<.01" if error < 0.01 else "%.2g" % error if error < 99.5 else ">99"


def stepsOf(schemes):
    """All steps of these schemes and of the default"""
    schemes = {"default", *schemes}
    return sorted({r["dt"] for r in table if r["scheme"] in schemes}, key=float)


def panel(ax, rows):
    steps = stepsOf(r["scheme"] for r in rows)
    heights = sorted({r["row"] for r in rows}, key=float)
    for r in rows:
        x, y = steps.index(r["dt"]), heights.index(r["row"])
        ax.add_patch(Rectangle((x - 0.5, y - 0.5), 1, 1, fc=colours[r["verdict"]], ec="white", lw=1))
        ax.text(x, y - 0.08, text(r), ha="center", va="center", fontsize=8)
        if r["allowed"] == "1":
            ax.plot(x - 0.39, y + 0.31, "o", ms=3.6, color="black")
        if int(r["retries"]):
            ax.plot(x + 0.38, y + 0.31, "v", ms=4.5, mfc="white", mec="black", mew=0.8)
    ax.set(xlim=(-0.5, len(steps) - 0.5), ylim=(-0.5, len(heights) - 0.5), xticks=range(len(steps)), yticks=range(len(heights)))
    ax.set_xticklabels(steps, fontsize=8)
    ax.set_yticklabels(heights, fontsize=8)
    ax.tick_params(length=0)
    ax.grid(False)
    for side in ax.spines.values():
        side.set_visible(False)


def legend(ax):
    ax.axis("off")
    handles = [Patch(fc=colours[v], label=label) for v, label in labels.items()]
    handles += [Line2D([], [], ls="", marker="o", ms=4, color="black", label="the log's limits allow the step"),
                Line2D([], [], ls="", marker="v", ms=5, mfc="white", mec="black", label="steps were taken back"),
                Line2D([], [], ls="", marker="$3$", ms=6, color="black", label="largest error in %, $\\dot\\gamma t$ = 1 to 2")]
    ax.legend(handles=handles, loc="center", fontsize=9)


table = records(sys.argv[1])
widths = [len(stepsOf([s])) for s in ("default", "explicit", "penalty")]
figure, axes = figures.columns(3, 1.85, 4.1, len(maps), widths=widths)
for axs, (name, label) in zip(axes, maps.items()):
    own = [r for r in table if r["map"] == name]
    schemes = [s for s in titles if any(r["scheme"] == s for r in own)]
    for ax, scheme in zip(axs, schemes):
        panel(ax, [r for r in own if r["scheme"] == scheme])
        if name in ("stiffness", "density"):
            ax.set_title(titles[scheme])
    for ax in axs[len(schemes):-1]:
        ax.axis("off")
    axs[0].set_ylabel(label)
    if len(schemes) < 3:
        legend(axs[2])
for ax in axes[-1][:2]:
    ax.set_xlabel("$\\dot\\gamma\\,\\Delta t$")
figures.save(figure, sys.argv[2], dpi=84)
