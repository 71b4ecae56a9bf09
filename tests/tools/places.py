"""Scenes that seedBodies wrote: places and directions, in a box periodic in x and z. The
box has its middle in the origin."""
import itertools
import re
import numpy as np
from distances import segments


def read(file):
    """Entries positions and directions, each n x 3."""
    with open(file) as f:
        text = f.read()
    rows = lambda entry: np.array([
        list(map(float, row.split()))
        for row in re.findall(r"\(([^()]+)\)", text[text.index(entry):].split(";")[0])])
    return rows("positions"), rows("directions")


def images(box):
    return [np.array([i * box, 0, k * box]) for i, k in itertools.product((-1, 0, 1), repeat=2)]


def apart(a, b, box, same):
    """Least distance of the segments a and b (first points, last points) over periodic
    images. same: b is a, and segments are not compared with themselves."""
    worst = np.inf
    for shift in images(box):
        d = segments(a[0][:, None], a[1][:, None], b[0] + shift, b[1] + shift)
        if same and not shift.any():
            np.fill_diagonal(d, np.inf)
        worst = min(worst, d.min())
    return worst


def least(file, box: float, length: float = 0):
    """Least distance of the bodies' axes, which begin at the places."""
    x, t = read(file)
    axes = (x, x + length * t)
    return "%.17g" % apart(axes, axes, box, True)


def leastBetween(file, half: float, other, length: float, box: float):
    """Least distance of axes about the places of one group and of axes that begin at the
    places of another."""
    (x, t), (y, s) = read(file), read(other)
    return "%.17g" % apart((x - half * t, x + half * t), (y, y + length * s), box, False)


def number(file):
    return len(read(file)[0])


def highest(file):
    """Largest |y| of a place."""
    return "%.17g" % abs(read(file)[0][:, 1]).max()


def isotropy(file, length: float, box: float):
    """Largest departure of the mean squares of directions from those of dilute fibres
    between walls: these leave a share 1 - q |t_y| of the height, q = length/box, so that
    the mean of t_y^2 is (1/3 - q/4)/(1 - q/2)."""
    _, t = read(file)
    q = length / box
    y = (1 / 3 - q / 4) / (1 - q / 2)
    return abs((t**2).mean(0) - [(1 - y) / 2, y, (1 - y) / 2]).max()


def deviation(file):
    """Root mean square of the angle from z in one direction, in degrees."""
    angle = np.degrees(np.arccos(read(file)[1][:, 2]))
    return np.sqrt((angle**2).mean() / 2)


def offZ(file):
    """Largest departure of a direction from z."""
    return abs(read(file)[1] - [0, 0, 1]).max()


def biconcaveSurface(number):
    """Squares of the distance from the axis and points of the surface of a biconcave cell
    of radius 1, at random."""
    e = np.random.default_rng(2).normal(size=(number, 3))
    e /= np.linalg.norm(e, axis=1)[:, None]
    z = np.sign(e[:, 2]) * halfThickness((e[:, :2]**2).sum(1))
    return e[:, :2], z


def halfThickness(r2):
    """Half the thickness of a biconcave cell of radius 1, at the square of the distance from its axis."""
    return 0.5 * np.sqrt(np.maximum(0, 1 - r2)) * (0.207 + 2.003 * r2 - 1.123 * r2**2)


def frame(axis):
    """Three directions, of which the last is the axis."""
    a = np.cross(axis, [1, 0, 0] if abs(axis[0]) < 0.7 else [0, 1, 0])
    a /= np.linalg.norm(a)
    return np.array([a, np.cross(axis, a), axis])


def cellsWithin(file, radius: float, box: float):
    """Number of points of biconcave cells that lie within others."""
    x, t = read(file)
    across, z = biconcaveSurface(2000)
    surface = radius * np.c_[across, z]
    inside = 0
    for i, shift, j in itertools.product(range(len(x)), images(box), range(len(x))):
        r = x[j] + shift - x[i]
        if (i == j and not shift.any()) or r @ r > (2 * radius)**2:
            continue
        points = surface @ frame(t[i]) + x[i]
        y = (points - x[j] - shift) @ frame(t[j]).T / radius
        r2 = (y[:, :2]**2).sum(1)
        inside += ((r2 < 1) & (abs(y[:, 2]) < halfThickness(r2))).sum()
    return int(inside)


def discsWithin(file, radius: float, box: float):
    """Number of points of biconcave discs of radius 3 along x, at x = -4, 0, 4, that lie
    within spheres at the places."""
    x, _ = read(file)
    across, z = biconcaveSurface(3000)
    inside = 0
    for centre, shift, c in itertools.product((-4, 0, 4), images(box), x):
        disc = 3 * np.c_[z, across] + [centre, 0, 0]
        inside += (((disc - c - shift)**2).sum(1) < radius**2).sum()
    return int(inside)
