"""Points of the study of fibres that settle (tests/validation/settlingFibres), in the folder of a run."""
import numpy as np
from deformablebodies import Case, Table
from rheology import seconds

case = Case()


def box():
    """Sides of the box over the length of a fibre."""
    cells = 1.482 * case.entry("ratio")
    return np.array([case.entry("across"), case.entry("up"), case.entry("across")]) / cells


def row(name, alone):
    """A line of the table. Velocities are over that of one fibre alone; clustering is the variance
    of the number of other centres within half a length over its mean, random that of centres
    anywhere; few and many are the velocities of fibres with the fewest and the most others."""
    one, oneError, _ = Case(alone).means("statistics", "fibres")["velocityY"]
    now = case.means("statistics", "fibres")
    velocity, error, deviation = now["velocityY"]
    error = np.hypot(error / one, velocity * oneError / one**2) if min(error, oneError) >= 0 else -1
    velocity, deviation, one = velocity / one, deviation / abs(one), -one
    others, _, probability, _, vy, _ = Table(case.latest("statistics", "fibres.concentration.dat")).rows.T
    mean = (others * probability).sum()
    clustering = ((others - mean)**2 * probability).sum() / mean
    common = np.flatnonzero(probability > 0.01)
    few, many = (-vy[common[k]] / one for k in (0, -1))
    number = case.entry("fibres")
    volume = box().prod()
    values = [number * np.pi / 4 / case.entry("ratio")**2 / volume, case.entry("stiffness"), velocity, error,
              deviation, few, many, clustering, 1 - np.pi / 6 / volume, now["axisYY"][0], seconds()]
    return name + "," + ",".join("%.5g" % v for v in values)
