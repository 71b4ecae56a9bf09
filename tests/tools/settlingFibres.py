"""Points of the study of fibres that settle (tests/validation/settlingFibres), in the folder of a run."""
import glob
import numpy as np
from dat import Table
from rheology import sceneEntry, seconds


def last(kind, folder="."):
    """The file of bodyStatistics that holds all samples."""
    files = glob.glob("%s/postProcessing/statistics/*/fibres.%s.dat" % (folder, kind))
    return max(files, key=lambda f: float(f.split("/")[-2]))


def means(folder="."):
    """Mean, error and deviation of each quantity."""
    lines = (line.split() for line in open(last("means", folder)) if not line.startswith("#"))
    return {w[0]: [float(x) for x in w[1:]] for w in lines}


def box():
    """Sides of the box over the length of a fibre."""
    cells = 1.482 * sceneEntry("ratio")
    return np.array([sceneEntry("across"), sceneEntry("up"), sceneEntry("across")]) / cells


def row(name, alone):
    """A line of the table. Velocities are over that of one fibre alone; clustering is the variance
    of the number of other centres within half a length over its mean, random that of centres
    anywhere; few and many are the velocities of fibres with the fewest and the most others;
    beside and above are pairs of centres over those at random within a tenth of a length."""
    one = -means(alone)["velocityY"][0]
    now = means()
    velocity, error, deviation = (x / one for x in now["velocityY"])
    others, _, probability, _, vy, _ = Table(last("concentration")).rows.T
    mean = (others * probability).sum()
    clustering = ((others - mean)**2 * probability).sum() / mean
    common = np.flatnonzero(probability > 0.01)
    few, many = (-vy[common[k]] / one for k in (0, -1))
    pairs = Table(last("pairs"))
    near = pairs["r"] < 0.25
    beside = 0.5 * (pairs["gX"] + pairs["gZ"])[near].mean()
    number = sceneEntry("fibres")
    volume = box().prod()
    values = [number * np.pi / 4 / sceneEntry("ratio")**2 / volume, sceneEntry("stiffness"), -velocity, error,
              deviation, few, many, clustering, 1 - np.pi / 6 / volume, beside, pairs["gY"][near].mean(),
              now["axisYY"][0], seconds()]
    return name + "," + ",".join("%.5g" % v for v in values)
