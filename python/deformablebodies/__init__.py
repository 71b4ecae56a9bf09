"""Reads, plots and repeats cases of deformableBodyFoam.

    from deformablebodies import Case

    case = Case("tutorials/capsule/shear")
    case.entry("Ca")                     # a number of constant/scene
    cells = case.bodies("cells")         # samples of a group: cells["time"], cells["D"]
    case.stress()["relativeViscosity"]   # bulkStress.dat
    case.means("statistics", "fibres")   # mean, error and deviation of each quantity
    case.shapes("cells")                 # (time, points) of each picture
    case.field("U")                      # values in the cells at the last time

    for settings, case in sweep("mine", "study", [{"Ca": 0.1}, {"Ca": 0.3}]):
        print(settings, case.bodies("cells")["D"][-1])

Modules: tables (files of columns), case (a case and its results), runs (copies of a case
with other entries), figures (one look of all plots), bodies3d (pictures of bodies).
"""
try:
    import numpy
except ModuleNotFoundError:
    raise ModuleNotFoundError("this Python has no numpy: use bin/python of the checkout, or install numpy and matplotlib")
from .case import Case
from .runs import sweep
from .tables import Table

__all__ = ["Case", "Table", "sweep"]
