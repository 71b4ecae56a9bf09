"""Points of the study of fibres that settle (tests/validation/settlingFibres), in the folder of a run."""
import numpy as np
from deformablebodies import Case, Table
from deformablebodies.tables import records
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


def trends(table):
    """Claims of rheology.md, each with what is missing at the worst row (at most 0: it holds), or none
    where rows are missing."""
    rows = [{k: float(v) for k, v in r.items() if k != "point"} for r in records(table)
            if not r["point"].endswith(".wide")]
    worst = lambda missing: np.max([missing(r) for r in rows]) if rows else None
    claims = [("together faster than one alone, by 3 errors", worst(lambda r: 3 - (r["velocity"] - 1) / r["error"])),
              ("with many neighbours over with few, at least 1.3", worst(lambda r: 1.3 - r["many"] / r["few"])),
              ("clustering over that at random, at least 1.2", worst(lambda r: 1.2 - r["clustering"] / r["random"]))]
    for stiffness in (1, 0.01):
        own = sorted((r for r in rows if r["stiffness"] == stiffness), key=lambda r: r["fraction"])
        slower = rises = None
        if len(own) == 3:
            middle, dense = own[1:]
            slower = 2.5 - (middle["velocity"] - dense["velocity"]) / np.hypot(middle["error"], dense["error"])
            rises = np.max(-np.diff([r["many"] / r["few"] for r in own]))
        claims += [("stiffness %g: slower at 3 than at 1.2 %%, by 2.5 errors" % stiffness, slower),
                   ("    with many over with few rises with the share", rises)]
    for claim, value in claims:
        print("%s|%s" % (claim, "none" if value is None else "%.3g" % value))
