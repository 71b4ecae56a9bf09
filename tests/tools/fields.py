"""Fields of OpenFOAM's files, ascii or binary: values of the cells."""
import glob
import re
import numpy as np
from deformablebodies.case import field


def addNoise(file, amplitude: float):
    """Adds noise, evenly distributed up to the amplitude, to a field of vectors that is not
    uniform. The file is ascii then, and what its boundary has must be uniform."""
    U = field(file)
    U = U + amplitude * np.random.default_rng(1).uniform(-1, 1, U.shape)
    with open(file, "rb") as f:
        data = f.read()
    begin = data.index(b"internalField")
    end = data.index(b"boundaryField")
    text = "internalField nonuniform List<vector> %d\n(\n%s\n);\n\n" % (
        len(U), "\n".join("(%.9g %.9g %.9g)" % tuple(u) for u in U))
    data = data[:begin].replace(b"binary", b"ascii") + text.encode() + data[end:]
    with open(file, "wb") as f:
        f.write(data)


def difference(a, b):
    """Largest difference of two fields of vectors, relative to the largest value."""
    a, b = field(a), field(b)
    return "%.2e" % (np.abs(a - b).max() / np.abs(b).max())


def rmsDifference(a, b):
    """Root mean square of the difference of two fields of vectors over that of the second."""
    a, b = field(a), field(b)
    return "%.2e" % np.sqrt(((a - b)**2).sum() / (b**2).sum())


def meanX(file):
    """Mean absolute value of the first component."""
    return "%.17g" % np.abs(field(file)[:, 0]).mean()


def resultant(file, other=None):
    """Sum of a field of forces over its largest value, or the largest difference from
    another field."""
    f = field(file)
    left = f.sum(0) if other is None else f - field(other)
    return "%.3g" % (abs(left).max() / abs(f).max())


def sumDifference(total, *parts):
    """Largest difference of a field from the sum of others, over its largest value."""
    f = field(total)
    return "%.3g" % (abs(f - sum(field(part) for part in parts)).max() / abs(f).max())


def taylorGreen(file, n: int):
    """Largest error of the first component of Taylor and Green's vortices (box 8, nu 0.2,
    time 1, n^3 cells), over what is left of them. The fluxes of the start are averages of
    cells, the velocity at the end is one of fluxes: each averages once."""
    U = field(file)[:, 0].reshape(n, n, n)
    x = -4 + (np.arange(n) + 0.5) * 8 / n
    k = np.pi / 4
    decay = np.exp(-2 * 0.2 * k * k)
    exact = decay * np.sin(k * x)[None, None, :] * np.cos(k * x)[None, :, None] * np.cos(k * 4 / n)**2
    return "%.4e" % (np.abs(U - exact).max() / decay)


def agreement(*cells: int):
    """Agreement of the flows staggered<n> and pimple<n> of two numbers of cells at time 0.48: mean
    square differences of the velocity, their order, and the difference of the pressure
    gradients of the finer."""
    U = lambda algorithm, n: field("%s%d/0.48/U" % (algorithm, n))
    d = [np.sqrt(np.mean((U("staggered", n) - U("pimple", n))**2)) for n in cells]
    gradient = lambda folder: float(re.findall(r"pressure gradient = (\S+)", open(folder + "/log.run").read())[-1])
    g = [gradient("%s%d" % (algorithm, cells[-1])) for algorithm in ("staggered", "pimple")]
    return (*("%.3e" % x for x in d), "%.2f" % np.log2(d[0] / d[1]), "%.2e" % abs(g[0] / g[1] - 1))


def rateOff(case):
    """Departure of the mean velocity along x from 1, at time 0.48."""
    return "%.1e" % abs(field(case + "/0.48/U")[:, 0].mean() - 1)


def wallViscosity(half: float, cells: int):
    """Viscosity of a suspension between walls at rate 1 over that of the fluid, from the
    velocity beside the walls: mean over the times written from 2 on, its standard error,
    and how many they are."""
    values = []
    for name in set(glob.glob("[0-9]*/U")) - {"0.orig/U"}:
        if float(name.split("/")[0]) >= 2:
            layers = field(name)[:, 0].reshape(cells, cells, cells).mean(axis=(0, 2))
            values.append(0.5 * ((half - layers[-1]) + (layers[0] + half)) / (half / cells))
    values = np.array(values)
    return values.mean(), values.std() / np.sqrt(len(values) / 4), len(values)
