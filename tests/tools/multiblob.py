"""Stress of a rigid cylinder or spheroid in a straining flow without inertia, by blobs on its
surface with the mobility of Rotne & Prager and Yamakawa, extrapolated to blobs without size.
A second computation beside slender-body theory, whose series converges slowly."""
import numpy as np


def surface(length, radius, around, shape):
    """Points about a spacing apart, in rings about z, and the spacing."""
    spacing = 2 * np.pi * radius / around
    rings = []
    if shape == "cylinder":
        n = int(round(length / spacing)) + 1
        rings = [(radius, z, around) for z in np.linspace(-length / 2, length / 2, n)]
        for end in (-length / 2, length / 2):
            for r in np.arange(radius - spacing, 0.3 * spacing, -spacing):
                rings.append((r, end, max(1, int(round(2 * np.pi * r / spacing)))))
            rings.append((0, end, 1))
    else:
        angle = np.linspace(0, np.pi, 4000)
        arc = np.cumsum(np.hypot(radius * np.cos(angle), length / 2 * np.sin(angle))) * angle[1]
        n = int(round(arc[-1] / spacing))
        for t in np.interp((np.arange(n) + 0.5) * arc[-1] / n, arc, angle):
            r = radius * np.sin(t)
            rings.append((r, length / 2 * np.cos(t), max(1, int(round(2 * np.pi * r / spacing)))))
    points = [(r * np.cos(a), r * np.sin(a), z) for r, z, n in rings
              for a in 2 * np.pi * np.arange(n) / n]
    return np.array(points), spacing


def coefficient(length, radius, around, shape):
    """A of the stress mu A (p.E.p) (p p - 1/3) of a body with axis p, over length^3."""
    x, spacing = surface(length, radius, around, shape)
    n, b = len(x), spacing / 2
    r = x[:, None] - x[None]
    d = np.sqrt((r**2).sum(-1)) + np.eye(n)
    far = d >= 2 * b
    same = np.where(far, (1 + 2 * b * b / (3 * d * d)) / (8 * np.pi * d), (1 - 9 * d / (32 * b)) / (6 * np.pi * b))
    along = np.where(far, (1 - 2 * b * b / d**2) / (8 * np.pi * d**3), 3 / (32 * b * d) / (6 * np.pi * b))
    np.fill_diagonal(same, 1 / (6 * np.pi * b))
    mobility = along[:, None, :, None] * np.einsum("ijk,ijl->ikjl", r, r)
    for c in range(3):
        mobility[:, c, :, c] += same
    strain = x * [-0.5, -0.5, 1]
    force = np.linalg.solve(mobility.reshape(3 * n, 3 * n), -strain.ravel()).reshape(n, 3)
    stress = -(force * x).sum(0)
    return (stress[2] - (stress[0] + stress[1]) / 2) / length**3


def extrapolated(aspect, shape, *around):
    """The coefficient for blobs without size, from two or more numbers of blobs around."""
    around = [int(n) for n in around]
    values = [coefficient(float(aspect), 0.5, n, shape) for n in around]
    return "%.4f" % np.polyfit([1 / n for n in around], values, len(around) - 1)[-1]
