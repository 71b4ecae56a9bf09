"""Distances of lines and surfaces: segments, points within surfaces, surfaces that cross."""
import glob
import itertools
import numpy as np
from deformablebodies import Case


def segments(p, q, r, s):
    """Shortest distances of the segments p-q and r-s (arrays of points that broadcast;
    a segment may be a point). Either an end is nearest, or both are met between the ends."""
    u, v, w = q - p, s - r, p - r
    dot = lambda a, b: (a * b).sum(-1)

    def end(a, b, c):
        """Point a from the segment b-c."""
        k = np.clip(dot(a - b, c - b) / np.maximum(dot(c - b, c - b), 1e-300), 0, 1)
        return np.linalg.norm(a - b - k[..., None] * (c - b), axis=-1)

    least = np.minimum.reduce([end(p, r, s), end(q, r, s), end(r, p, q), end(s, p, q)])
    n = dot(u, u) * dot(v, v) - dot(u, v)**2
    with np.errstate(all="ignore"):
        a = (dot(u, v) * dot(v, w) - dot(v, v) * dot(u, w)) / n
        b = (dot(u, u) * dot(v, w) - dot(u, v) * dot(u, w)) / n
        cross = np.linalg.norm(w + a[..., None] * u - b[..., None] * v, axis=-1)
    within = (a > 0) & (a < 1) & (b > 0) & (b < 1)
    return np.where(within, np.minimum(least, cross), least)


def closestLines(lines, periods):
    """Least distance of any two lines in a box with these periods. Pairs whose
    bounds are further apart than 1 are left out, and segments whose middles show that they
    are further apart than others."""
    middle = np.array([(l.min(0) + l.max(0)) / 2 for l in lines])
    half = np.array([(l.max(0) - l.min(0)) / 2 for l in lines])
    worst = np.inf
    size = [np.linalg.norm(np.diff(l, axis=0), axis=1) / 2 for l in lines]
    for i, a in enumerate(lines):
        shift = middle[i] - middle[:i]
        shift -= periods * np.round(shift / periods)
        for j in np.flatnonzero((abs(shift) < half[i] + half[:i] + 1).all(1)):
            b = lines[j] + (middle[i] - middle[j] - shift[j])
            apart = np.linalg.norm((a[:-1] + a[1:])[:, None] - b[:-1] - b[1:], axis=-1) / 2
            k, m = np.nonzero(apart - size[i][:, None] - size[j] < worst)
            if len(k):
                worst = min(worst, segments(a[k], a[k + 1], b[m], b[m + 1]).min())
    return worst


def closest(period, *pictures):
    """Least distance of two lines in any of the pictures; several files that are one
    picture are joined by commas. The box has this period in x and z, or one in x, one
    in y and one in z, joined by commas."""
    import vtp
    periods = [float(p) for p in str(period).split(",")]
    periods = np.array(periods if len(periods) == 3 else (periods[0], 1e300, periods[0]))
    least = [closestLines(sum(map(vtp.lines, picture.split(",")), []), periods) for picture in pictures]
    return "%.5g" % min(least, default=np.nan)


def ownParts(x, apart, number=600):
    """Least distance of two parts of a line that are so far apart along it, from a number
    of points at equal distances."""
    s = np.r_[0, np.cumsum(np.linalg.norm(np.diff(x, axis=0), axis=1))]
    t = np.linspace(0, s[-1], number)
    y = np.array([np.interp(t, s, x[:, d]) for d in range(3)]).T
    distance = np.linalg.norm(y[:, None] - y[None], axis=2)
    return distance[np.abs(t[:, None] - t[None]) > apart].min()


def meets(apart: float, *files):
    """Least distance of parts of one line that are so far apart along it."""
    import vtp
    return "%.4g" % min(ownParts(vtp.points(file), apart) for file in files)


def gaps(first, second, diameter: float):
    """Time and gap over the diameter of two groups of one line each, for each picture: a
    line a picture."""
    import vtp
    for (time, one), (_, other) in zip(Case().pictures(first), Case().pictures(second)):
        a, b = (refined(vtp.points(file), 20) for file in (one, other))
        print(time, (np.linalg.norm(a[:, None] - b[None], axis=-1).min() - diameter) / diameter)


def refined(x, parts):
    """Points of a line with each segment in a number of parts."""
    s = np.linspace(0, len(x) - 1, parts * (len(x) - 1) + 1)
    i = np.minimum(s.astype(int), len(x) - 2)
    return x[i] + (s - i)[:, None] * (x[i + 1] - x[i])


def enclosed(*files):
    """Largest number of points of bodies that lie inside others, of all pictures."""
    import vtp
    return max(enclosedPoints(vtp.bodies(file)) for file in files)


def enclosedPoints(bodies):
    from vtkmodules.vtkFiltersModeling import vtkSelectEnclosedPoints
    import vtp
    inside = 0
    for a, b in itertools.permutations(bodies, 2):
        test = vtkSelectEnclosedPoints()
        test.SetInputData(a)
        test.SetSurfaceData(b)
        test.Update()
        inside += int(vtp.array(test.GetOutput(), "SelectedPoints").sum())
    return inside if len(bodies) > 1 else np.nan


def cross(a, b, move=(0, 0, 0)):
    """Whether triangles of two surfaces cross, the first moved."""
    from vtkmodules.vtkCommonMath import vtkMatrix4x4
    from vtkmodules.vtkCommonTransforms import vtkTransform
    from vtkmodules.vtkFiltersModeling import vtkCollisionDetectionFilter
    p, q = a.GetBounds(), b.GetBounds()
    if any(p[2 * d] + move[d] > q[2 * d + 1] or q[2 * d] > p[2 * d + 1] + move[d] for d in range(3)):
        return False
    transform = vtkTransform()
    transform.Translate(move)
    test = vtkCollisionDetectionFilter()
    test.SetInputData(0, a)
    test.SetInputData(1, b)
    test.SetTransform(0, transform)
    test.SetMatrix(1, vtkMatrix4x4())
    test.SetCollisionModeToFirstContact()
    test.Update()
    return test.GetNumberOfContacts() > 0


def crossingPairs(bodies, period, shift=0):
    """Pairs of bodies whose surfaces cross, in a box with this period in x and z; the
    first body moved along x by shift."""
    number = 0
    for i, a in enumerate(bodies):
        for j, b in enumerate(bodies):
            for kx, kz in itertools.product((-1, 0, 1), repeat=2):
                if j < i or (i == j and (kx, kz) <= (0, 0)):
                    continue
                number += cross(a, b, (kx * period + (shift if i == 0 else 0), 0, kz * period))
    return number


def crossing(group, expected: int, period: float, shift: float = 0):
    """Pairs of bodies that cross in all pictures of a group, each of which must have the
    expected number of bodies."""
    import vtp
    number = pictures = 0
    for file in sorted(glob.glob("postProcessing/VTK/bodies/%s_*.vtp" % group)):
        bodies = vtp.bodies(file)
        if len(bodies) != expected:
            raise SystemExit("%s has %d bodies" % (file, len(bodies)))
        pictures += 1
        number += crossingPairs(bodies, period, shift)
    return number if pictures > 1 else np.nan


def depth(outer, inner):
    """Largest distance of a point of the group inner beyond the surface of the group
    outer, of all pictures. Negative: inside."""
    import vtp
    files = glob.glob("postProcessing/VTK/bodies/%s_*.vtp" % outer)
    depths = [beyond(vtp.read(file), vtp.points(file.replace(outer + "_", inner + "_"))) for file in files]
    return "%.4f" % max(depths, default=np.nan)


def gap(group):
    """Least distance of a point of the first body from the surface of the second, of all
    pictures."""
    import vtp
    pairs = [vtp.bodies(file) for _, file in Case().pictures(group)]
    return "%.4f" % min(-beyond(second, vtp.pointsOf(first), -1) for first, second in pairs)


def beyond(surface, points, sign=1):
    """Largest signed distance of points from a closed surface, positive outside; times sign."""
    from vtkmodules.vtkFiltersCore import vtkImplicitPolyDataDistance
    import vtp
    distance = vtkImplicitPolyDataDistance()
    distance.SetInput(vtp.triangles(surface))
    return max(sign * distance.EvaluateFunction(x) for x in points)
