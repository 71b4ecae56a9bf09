"""Pictures that studies draw of their tables."""
import glob
import re
import numpy as np
from deformablebodies.figures import plt
from deformablebodies.tables import records


def rigidGaps(table, picture):
    """Resistance of spheres against the gap, measured and from theory."""
    rows = records(table)
    names = {"spheres": "two spheres towards each other", "towards": "sphere towards a wall",
             "along": "sphere along a wall"}
    figure, axes = plt.subplots(1, 3, figsize=(11, 3.6), constrained_layout=True)
    for axis, (case, name) in zip(axes, names.items()):
        mine = [r for r in rows if r["case"] == case]
        line = sorted({(float(r["gapOverRadius"]), float(r["theory"])) for r in mine})
        axis.plot(*zip(*line), "k-", label="theory")
        for cells in sorted({r["cellsPerRadius"] for r in mine}, key=float):
            some = [r for r in mine if r["cellsPerRadius"] == cells]
            axis.plot([float(r["gapOverRadius"]) for r in some], [float(r["resistance"]) for r in some],
                      "o", label="radius %s h" % cells)
            axis.axvline(1 / float(cells), color="0.8", lw=1)
        axis.set(xscale="log", yscale="log" if case != "along" else "linear", xlabel="gap over radius", title=name)
    axes[0].set_ylabel("force over 6 pi mu a U")
    axes[0].legend()
    figure.savefig(picture, dpi=90)


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
    colours = {"none": "k", "capsule": "tab:blue", "rigid": "tab:red"}
    names = {"none": "no nucleus", "capsule": "capsule, ten times as stiff", "rigid": "rigid"}
    figure, axes = plt.subplots(1, 4, figsize=(13, 3.6), constrained_layout=True)
    for bending, line in (("0", "o-"), ("0.0125", "s--")):
        for kind, colour in colours.items():
            own = [r for r in rows if r["case"] == kind and r["bending"] == bending]
            axes[0].plot([float(r["Ca_G"]) for r in own], [float(r["D"]) for r in own], line, color=colour,
                         mfc="none" if bending != "0" else colour,
                         label=names[kind] if bending == "0" else None)
    axes[0].set(xlabel="Ca_G", ylabel="D at rate t = 8", title="dashed: bending 0.0125 a^2 Gs")
    axes[0].legend(fontsize=8)
    for axis, Ca in zip(axes[1:], ("0.1", "0.3", "0.5")):
        for kind, colour in colours.items():
            folder = kind + "-" + Ca + "-0"
            axis.plot(*section(folder, "cells").T, color=colour)
            if kind != "none":
                axis.plot(*section(folder, "cellsNucleus").T, color=colour)
        axis.set(aspect="equal", xlim=(-2.1, 2.1), ylim=(-1.4, 1.4), title="Ca_G " + Ca + ", no bending")
    figure.savefig(picture, dpi=90)
