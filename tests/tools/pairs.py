"""Two capsules that pass each other, against boundary integrals."""
import re
import numpy as np
from deformablebodies import Table


def first(file):
    """Times, y and D of the first body of a .dat file."""
    table = Table(file)
    mine = table["body"] == 0
    return table["time"][mine], table["y"][mine], table["D"][mine]


def at(file, times):
    """y and D of the first body at given times."""
    t, y, D = first(file)
    return np.interp(times, t, y), np.interp(times, t, D)


def compare(integrals, large, small, file, largeSide: float = 12, smallSide: float = 8):
    """Prints y and D of boundary integrals in an unbounded flow and of a run, whose box is
    taken out by two runs in a large and in its own box; ends with the largest departures."""
    rows = re.findall(r"t +(\S+)  D (\S+) .*centre \S+ (\S+)  gap (\S+)", open(integrals).read())
    t, D, y, gap = np.array(rows, float).T
    share = 1 / (1 - (smallSide / largeSide) ** 3)
    (yl, Dl), (ys, Ds), (yr, Dr) = (at(f, t) for f in (large, small, file))
    box = share * (yl - ys), share * (Dl - Ds)
    y1, D1 = yr + box[0], Dr + box[1]
    for row in zip(t, y, y1, D, D1, box[0], gap):
        print("    t %4g  y %.4f, here %.4f  D %.4f, here %.4f  by the box %.4f  gap %.3f" % row)
    return np.abs(y1 - y).max(), np.abs(D1 / D - 1).max()


def gap(integrals):
    """Smallest gap of boundary integrals."""
    return min(re.findall(r"gap (\S+)", open(integrals).read()), key=float)


def change(file, other):
    """Change of the last y from a file to another, over y."""
    y, z = first(file)[1][-1], first(other)[1][-1]
    return abs(z / y - 1)


def last(file):
    """The last y."""
    return first(file)[1][-1]


def departure(reference, file, column):
    """Largest difference of a column of the first body from that of a reference, at times of
    the file."""
    (t, a), (s, b) = ((table["time"][mine], table[column][mine])
                      for table, mine in ((table, table["body"] == 0) for table in (Table(reference), Table(file))))
    return np.abs(np.interp(s, t, a) - b).max()
