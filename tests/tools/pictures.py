"""Pictures that studies draw of their tables."""
import glob
import re
import numpy as np
from deformablebodies import figures
from deformablebodies.tables import records


def rigidGaps(table, picture):
    """Resistance of spheres against the gap, measured and from theory."""
    rows = records(table)
    names = {"spheres": "two spheres towards each other", "towards": "sphere towards a wall",
             "along": "sphere along a wall"}
    figure, axes = figures.columns(3, width=3.4)
    for axis, (case, name) in zip(axes, names.items()):
        mine = [r for r in rows if r["case"] == case]
        line = sorted({(float(r["gapOverRadius"]), float(r["theory"])) for r in mine})
        axis.plot(*zip(*line), **figures.theory, label="theory")
        for cells, colour in zip(sorted({r["cellsPerRadius"] for r in mine}, key=float),
                                 (figures.black, figures.blue, figures.green)):
            some = [r for r in mine if r["cellsPerRadius"] == cells]
            axis.plot([float(r["gapOverRadius"]) for r in some], [float(r["resistance"]) for r in some],
                      "o", color=colour, label="$a/h$ = %s" % cells)
            axis.axvline(1 / float(cells), color=colour, lw=1, alpha=0.3, label="a cell")
        axis.set(xscale="log", yscale="log" if case != "along" else "linear", xlabel="gap/$a$", title=name)
        for side in (axis.xaxis, axis.yaxis):
            figures.plainTicks(side)
    axes[0].set_ylabel(r"force/$6\pi\mu a U$")
    axes[0].legend()
    figures.save(figure, picture)


def section(folder, group):
    """Outline in the plane z = 0 of the last picture of a group of one body."""
    from vtkmodules.vtkCommonDataModel import vtkPlane
    from vtkmodules.vtkFiltersCore import vtkCutter
    import vtp
    files = glob.glob(folder + "/postProcessing/VTK/bodies/" + group + "_*.vtp")
    cut = vtkCutter()
    cut.SetInputData(vtp.read(max(files, key=lambda f: int(re.findall(r"_(\d+)\.vtp", f)[0]))))
    plane = vtkPlane()
    plane.SetNormal(0, 0, 1)
    cut.SetCutFunction(plane)
    cut.Update()
    x = vtp.pointsOf(cut.GetOutput())[:, :2]
    x = x[np.argsort(np.arctan2(x[:, 1] - x[:, 1].mean(), x[:, 0] - x[:, 0].mean()))]
    return np.vstack([x, x[:1]])


def nucleus(table, picture):
    """D against Ca_G, and outlines of cells and nuclei, of the cases beside the table."""
    rows = records(table)
    colours = {"none": figures.black, "capsule": figures.blue, "rigid": figures.orange}
    names = {"none": "no nucleus", "capsule": "capsule, ten times as stiff", "rigid": "rigid"}
    figure, axes = figures.columns(4, width=3.3)
    for bending, line in (("0", "o-"), ("0.0125", "s--")):
        for kind, colour in colours.items():
            own = [r for r in rows if r["case"] == kind and r["bending"] == bending]
            axes[0].plot([float(r["Ca_G"]) for r in own], [float(r["D"]) for r in own], line, color=colour,
                         mfc="none" if bending != "0" else colour,
                         label=names[kind] if bending == "0" else None)
    axes[0].set(xlabel="$Ca_G$", ylabel=r"$D$ at $\dot\gamma t$ = 8", title=r"dashed: bending 0.0125 $a^2 G_s$")
    axes[0].legend()
    for axis, Ca in zip(axes[1:], ("0.1", "0.3", "0.5")):
        for kind, colour in colours.items():
            folder = kind + "-" + Ca + "-0"
            look = {"color": colour, "ls": "--" if kind == "rigid" else "-"}
            axis.plot(*section(folder, "cells").T, **look)
            if kind != "none":
                axis.plot(*section(folder, "cellsNucleus").T, **look)
        axis.set(aspect="equal", xlim=(-2.1, 2.1), ylim=(-1.4, 1.4), xlabel="$x/a$", title="$Ca_G$ = " + Ca + ", no bending")
    axes[1].set_ylabel("$y/a$")
    figures.save(figure, picture)
