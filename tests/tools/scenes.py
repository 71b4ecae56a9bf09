"""Input of test cases: places of bodies, decompositions, surfaces of triangles."""
import itertools
import textwrap
import numpy as np


def rows(vectors, format="%.9g"):
    return "(" + "".join("(%s)\n" % " ".join(format % x for x in v) for v in vectors) + ")"


def scattered(number: int, x: float, y: float, z: float, *beyond: float):
    """Entries positions and directions of filaments at random in a box of these half
    widths about the origin, whose ends stay within the sum of beyond from walls in y."""
    half = np.array([x, y, z])
    random = np.random.default_rng(1)
    t = random.normal(size=(number, 3))
    t /= np.linalg.norm(t, axis=1)[:, None]
    places = random.uniform(-half, half, (number, 3))
    places[:, 1] *= 1 - sum(beyond) / y
    return "positions %s;\ndirections %s;" % (rows(places), rows(t))


def bundle(arrangement, number: int, ends):
    """constant/deformableBodies with fibres of ten cells of 1/3: parallel ones a quarter
    of a cell apart, crossing ones (in the plane of shear where they are free, across it
    where they are held), or all at one place."""
    h = 1 / 3
    length = 10 * h
    first, t = np.tile((0.05, -1.6, 0.07), (number, 1)), np.tile((0., 1, 0), (number, 1))
    if arrangement == "parallel":
        side = int(np.ceil(np.sqrt(number)))
        for i in range(number):
            first[i] += h / 4 * np.array((i % side, 0, i // side))
    if arrangement == "crossing":
        a = np.pi * np.arange(number) / number
        t = np.stack((np.sin(a), np.cos(a), 0 * a) if ends == "free" else (0 * a, np.cos(a), np.sin(a)), 1)
        first = np.array((0.05, 0.11, 0.07)) - 0.5 * length * t
    return """FoamFile { version 2.0; format ascii; class dictionary; object deformableBodies; }
bodies { fibres { type filament; length %.12g; diameter 0.2; segments 10;
bendingRigidity %g; ends (%s free);
positions %s; directions %s; } }""" % (
        length, *((5e6, "clamped") if ends == "held" else (5, "free")), rows(first, "%.12g"), rows(t, "%.12g"))


def fibreRows(number: int, apart: float, length: float = 3):
    """Entries positions and directions of parallel fibres in a square pattern, their
    axes that far apart."""
    side = int(np.ceil(np.sqrt(number)))
    first = [(-0.5 * length, apart * (i // side - 0.5 * (side - 1)), apart * (i % side - 0.5 * (side - 1)))
             for i in range(number)]
    return "positions %s;\ndirections %s;" % (rows(first), rows([(1, 0, 0)] * number))


def unevenBlocks():
    """constant/cellDecomposition of 32^3 cells: six blocks whose cuts do not meet, in no
    direction the same for all lines."""
    z, y, x = np.mgrid[0:32, 0:32, 0:32]
    left = np.where(y < 10, 0, np.where(z < 21, 1, 2))
    right = np.where(z < 13, 3, np.where(y < 17, 4, 5))
    rank = np.where(x < 20, left, right).ravel()
    return "\n".join(["FoamFile { version 2.0; format ascii; class labelList; object cellDecomposition; }",
                      str(rank.size), "(", *map(str, rank), ")"])


def stl(triangles):
    """Text of a file .stl, from triangles of three points each."""
    lines = ["solid surface"]
    for triangle in triangles:
        lines += ["facet normal 0 0 0", "outer loop"]
        lines += ["vertex %.12g %.12g %.12g" % tuple(v) for v in triangle]
        lines += ["endloop", "endfacet"]
    return "\n".join(lines + ["endsolid surface"])


def bowTie():
    """Two tetrahedra that share a point, one of them inside out."""
    all = []
    for s in (1, -1):
        p = [(0, 0, 0), (s, 1, 0), (s, -1, 1), (s, -1, -1)]
        all += [[p[i] for i in t] for t in ((0, 1, 2), (0, 2, 3), (0, 3, 1), (1, 3, 2))]
    return stl(all)


def octahedron(turned: int):
    """With one triangle turned round; -1: none."""
    all = []
    for k, s in enumerate(itertools.product((-1, 1), repeat=3)):
        t = np.diag(np.array(s, float))
        all.append(t[::-1] if (np.linalg.det(t) < 0) != (k == turned) else t)
    return stl(all)


def ellipsoid(n: int = 48, bumps: float = 0):
    """About (5 0 0), semi-axes 0.8, 1.1 and 1, of n by 2 n quadrangles halved; bumps: amplitude of
    waves of degree 12 over the radius."""
    t, p = np.meshgrid(np.linspace(0, np.pi, n + 1), np.linspace(0, 2 * np.pi, 2 * n + 1), indexing="ij")
    r = 1 + bumps * np.sin(t)**12 * np.cos(12 * p)
    x = np.stack([5 + 0.8 * r * np.sin(t) * np.cos(p), 1.1 * r * np.sin(t) * np.sin(p), r * np.cos(t)], -1)
    x[:, -1] = x[:, 0]
    x[0], x[-1] = x[0, 0], x[-1, 0]
    all = []
    for i, j in itertools.product(range(n), range(2 * n)):
        a, b, c, d = x[i, j], x[i + 1, j], x[i + 1, j + 1], x[i, j + 1]
        all += [t for t in ((a, b, c), (a, c, d)) if np.linalg.norm(np.cross(t[1] - t[0], t[2] - t[0])) > 1e-12]
    return stl(all)
