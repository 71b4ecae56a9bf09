"""Files .dat of bodies and samples: a line of names that begins with #, then numbers."""
import glob
import os
import numpy as np
from deformablebodies import Case, Table


def difference(a, b, kind="bodies"):
    """Largest difference of two files over their rows of a time and a body, relative to
    the largest value of the column, or to 1 where that is larger. kind table: rows of a
    time, all columns relative to their own values. Rows before the first time of either
    file are left out: of a restart. Not a number where a row of the others is in one
    file only: a run that broke off or a body that was lost is no agreement."""
    tables = [Table(file).rows for file in (a, b)]
    if not all(map(len, tables)):
        return np.nan
    keys, floor = (1, 0) if kind == "table" else (2, 1)
    first = max(rows[0, 0] for rows in tables) - 1e-7
    a, b = ({(round(row[0], 7), *row[1:keys]): row[keys:] for row in rows if row[0] >= first} for rows in tables)
    if a.keys() != b.keys():
        return np.nan
    x, y = np.array(list(a.values())), np.array([b[key] for key in a])
    return "%.2e" % (np.abs(x - y) / np.maximum(np.abs(x).max(0), floor)).max()


def largestDifference(a, b):
    """Largest difference of two tables over the rows whose first words are equal, to nine
    digits where these are numbers, relative to the largest number of a column or to a
    thousandth of that of the file. The second may begin later: of a restart. Not a number
    where a row after that is in one of them only."""

    def read(file):
        rows = {}
        for line in open(file):
            if line.startswith("#"):
                continue
            first, *rest = line.split()
            try:
                first = "%.9g" % float(first)
            except ValueError:
                pass
            rows[first] = [float(x) for x in rest]
        return rows

    a, b = read(a), read(b)
    if not b or list(a)[-len(b):] != list(b):
        return np.nan
    x, y = (np.array([rows[key] for key in b]) for rows in (a, b))
    scale = np.maximum(np.abs(x).max(0), 1e-3 * np.abs(x).max())
    return "%.2e" % (np.abs(x - y) / scale).max()


def lastDifference(folder, run, other, column):
    """First file of bodies in two runs: largest difference of a column over the
    bodies at the last time, relative to the largest value of the first run, and both
    means."""
    values = []
    for case in (run, other):
        table = Table(sorted(glob.glob("%s/%s/postProcessing/bodies/0/*.dat" % (folder, case)))[0])
        time = table.rows[:, 0]
        last = table.rows[time == time[-1]]
        x = last[np.argsort(last[:, 1]), table.names.index(column)]
        values.append((time[-1], x, abs(table[column]).max()))
    (t, a, size), (s, b, _) = values
    worst = abs(a - b).max() / size if abs(t - s) < 1e-6 else np.nan
    return "%.5g" % worst, a.mean(), b.mean()


def endsApart(a, b, column):
    """Largest difference of a column of two files over the bodies at the last time, relative
    to the largest value that the second has then. Not a number where the last times differ."""
    a, b = Table(a), Table(b)
    last = [t.rows[t["time"] == t["time"][-1]] for t in (a, b)]
    if abs(a["time"][-1] - b["time"][-1]) > 1e-6 or len(last[0]) != len(last[1]):
        return np.nan
    x, y = (rows[np.argsort(rows[:, 1]), a.names.index(column)] for rows in last)
    return "%.3g" % (abs(x - y).max() / abs(y).max())


def dragAndSlip(file):
    """Drag of bundles: total force along x (mean of the last tenth of three units of time),
    largest slip of the second half and of the first."""
    table = Table(file)
    time, force, slip = (table[name] for name in ("time", "forceX", "slip"))
    last = time > 2.7
    return force[last].sum() / len(np.unique(time[last])), slip[time > 1.5].max(), slip[time <= 1.5].max()


def settling(file, slope=""):
    """Velocity of a sphere of weight along (0.6 -0.8 0) over that of a periodic array of
    spheres (box of 8 radii), velocity across and slip over Stokes' velocity. With slope
    the velocity is that of the places after t = 0.3, and there is no slip."""
    import theory
    table = Table(file)
    if slope:
        late = table["time"] > 0.3
        u, v = (np.polyfit(table["time"][late], table.rows[late, c], 1)[0] for c in (2, 3))
        slip = []
    else:
        u, v, slip = table.rows[-1][[5, 6, -1]]
        slip = ["%.1e" % (slip / theory.stokes)]
    array = theory.hasimoto(4 / 3 * np.pi / 8**3)
    return ("%.5f" % ((0.6 * u - 0.8 * v) / (theory.stokes * array)),
            "%.1e" % (abs(0.8 * u + 0.6 * v) / theory.stokes), *slip)


def halfTurn(file):
    """Time in which a spheroid whose axis is in columns 11 and 12 has turned by 2 pi."""
    d = Table(file).rows
    angle = np.unwrap(2 * np.arctan2(d[:, 12], d[:, 11])) / 2
    return np.interp(2 * np.pi, -angle, d[:, 0])


def capsuleStress(file, time: float, side: float):
    """Shear stress, N1 and N2 of the group cells at a time, over mu times the rate and the share
    of a capsule of radius 1 in the cubic box of a side."""
    table = Table(file)
    row = abs(table["time"] - time).argmin()
    part = lambda axes: table["cells" + axes][row] * side**3 / (4 * np.pi / 3)
    return "%.5f %.5f %.5f" % (part("XY"), part("XX") - part("YY"), part("YY") - part("ZZ"))


def trace(file, part):
    """Largest trace of a part of the bulk stress over its largest shear stress."""
    table = Table(file)
    return "%.2e" % (abs(sum(table[part + axes] for axes in ("XX", "YY", "ZZ"))).max() / abs(table[part + "XY"]).max())


def increments(folder, nu: float):
    """Largest relative difference of the mean square gradient that structureFunctions.dat
    has over its first distance, a cell, from the dissipation over nu; all times."""
    rows = np.loadtxt(folder + "/0/turbulence.dat")
    worst = 0
    files = glob.glob(folder + "/*/structureFunctions.dat")
    for file in files:
        r, longitudinal, transverse = np.loadtxt(file)[0]
        row = rows[abs(rows[:, 0] - float(os.path.basename(os.path.dirname(file)))).argmin()]
        worst = max(worst, abs((3 * longitudinal + 6 * transverse) / r**2 / (row[2] / nu) - 1))
    return "%.2e" % (worst if files else np.inf)


def energyBalance(folder, begin: float, volume: float = 1, *groups):
    """Departure from 1 of the mean power of the forcing, and of the bodies of groups in a volume,
    over dissipation and growth of the kinetic energy, from a time on."""
    case = Case(folder)
    late = case.table("spectrum", "turbulence.dat").after(begin)
    t, K = late["time"], late["kineticEnergy"]
    mean = lambda t, x: (0.5 * (x[1:] + x[:-1]) * np.diff(t)).sum() / (t[-1] - t[0])
    power = mean(t, late["forcingPower"])
    for group in groups:
        samples = case.bodies(group).after(begin)
        times, which = np.unique(samples["time"], return_inverse=True)
        power += mean(times, np.bincount(which, samples["power"])) / volume
    return "%.4f" % abs(power / (mean(t, late["dissipation"]) + (K[-1] - K[0]) / (t[-1] - t[0])) - 1)


def turbulenceApart(folder, other):
    """Dissipation and kinetic energy at the last time, departures from those of another run."""
    last = [Case(name).table("spectrum", "turbulence.dat").rows[-1] for name in (folder, other)]
    return "%+.2e | %+.2e" % tuple(last[0][[2, 1]] / last[1][[2, 1]] - 1)


def kineticEnergy(file, cells: int):
    """ABC flow of amplitude 1 in a box of 2 pi after t = 150: largest departure from
    the energy of its discrete curl, and drift between the halves of that time."""
    t, K = np.loadtxt(file).T[:2]
    h = 2 * np.pi / cells
    late = t > 150
    ratio = K[late] / (1.5 * (1 + h * h / 6))
    n = late.sum() // 2
    return "%.3e" % abs(ratio - 1).max(), "%.3e" % abs(ratio[:n].mean() - ratio[n:].mean())
