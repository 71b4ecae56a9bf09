"""Solutions that runs are compared with. Viscosity 1 unless an argument says otherwise."""
import sys
from math import log, pi
import numpy as np

# Settling velocity of a sphere of radius 1 in the tests: weight less buoyancy 10, viscosity 20
stokes = 2 / 9 * 10 / 20


def hasimoto(c: float):
    """Settling velocity of a simple cubic array of spheres with this volume fraction over
    Stokes' (Hasimoto 1959)."""
    return 1 - 1.7601 * c**(1 / 3) + c - 1.5593 * c**2


def cylinderRadius(drag: float, side: float, along: int):
    """Radius of the cylinders in a square array with this drag per length at velocity 1,
    along or across them (Drummond & Tahir 1984)."""
    def of(radius):
        c = pi * radius**2 / side**2
        if along:
            return 4 * pi / (-log(c) - 1.476336 + 2 * c - 0.5 * c * c)
        return 4 * pi / (-0.5 * log(c) - 0.738168 + c - 0.887 * c * c)
    low, high = 0.1, 3.0
    for _ in range(60):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if of(middle) < drag else (low, middle)
    return "%.4f" % low


def sphereResistance(case, gap: float):
    """Force over 6 pi mu a U: two spheres towards each other or a sphere towards a wall
    (Brenner 1961), or along it (Goldman, Cox & Brenner 1967). gap: over the radius."""
    if case == "along":
        # Centre over radius, force over Stokes'; interpolated in logarithms
        table = np.array([(1.0453, 2.6475), (1.1276, 2.1514), (1.5431, 1.5675), (2.3524, 1.3079),
                          (3.7622, 1.1738), (10.0677, 1.0591)])
        x = np.log(table[:, 0] - 1)
        return "%.16g" % (1 + np.exp(np.polyval(np.polyfit(x, np.log(table[:, 1] - 1), 4), np.log(gap))))
    alpha = np.arccosh(1 + (gap if case == "towards" else gap / 2))
    n = np.arange(1, 2000)
    k = 2 * n + 1
    k, n = k[k * alpha < 600], n[k * alpha < 600]
    sinh = np.sinh(alpha)
    if case == "towards":
        f = (2 * np.sinh(k * alpha) + k * np.sinh(2 * alpha)) / (
            4 * np.sinh(k * alpha / 2)**2 - k**2 * sinh**2)
    else:
        f = (4 * np.cosh(k * alpha / 2)**2 + k**2 * sinh**2) / (
            2 * np.sinh(k * alpha) - k * np.sinh(2 * alpha))
    return "%.16g" % (4 / 3 * sinh * np.sum(n * (n + 1) / ((2 * n - 1) * (2 * n + 3)) * (f - 1)))


def startFromRest(file, fromTime: float):
    """Largest error of the velocity of a sphere that starts from rest (density ratio 1.5,
    weight less buoyancy 0.002 per volume, radius 1, nu 1) in a periodic box of 16, after
    fromTime. Prints the errors at some times to stderr."""
    ratio, L, V = 1.5, 16.0, 4 / 3 * np.pi
    F = 0.002 * V
    d = np.loadtxt(file)
    t, v = d[:, 0], d[:, 6]

    # Unbounded fluid (Basset, Boussinesq, Oseen): (ratio + 1/2) V u' + 6 pi u
    # + 6 sqrt(pi) int u'/sqrt(t - s) ds = F, u in straight pieces
    n = 2000
    s = t[-1] * (np.arange(n + 1) / n)**2
    u, a = np.zeros(n + 1), np.zeros(n)
    for k in range(1, n + 1):
        w = 2 * (np.sqrt(s[k] - s[:k]) - np.sqrt(s[k] - s[1:k + 1]))
        history = (a[:k - 1] * w[:k - 1]).sum()
        dt = s[k] - s[k - 1]
        a[k - 1] = (F - 6 * np.pi * u[k - 1] - 6 * np.sqrt(np.pi) * history) / (
            (ratio + 0.5) * V + 6 * np.pi * dt + 6 * np.sqrt(np.pi) * w[k - 1])
        u[k] = u[k - 1] + a[k - 1] * dt

    # Images: a point force in the box less that in unbounded fluid, at its own place
    q = np.sum(np.stack(np.meshgrid(*3 * [np.arange(-3, 4)]))**2, 0).ravel()
    q = q[q > 0]
    images = lambda x: 2 / 3 * ((4 * np.pi * x)**-1.5 * np.exp(-q * L**2 / 4 / x).sum() - L**-3)
    m = 1000
    s1 = np.linspace(0, t[-1], m + 1)
    u1 = np.interp(s1, s, u)
    f = F - (ratio - 1) * V * np.gradient(u1, s1)
    K = np.array([images(x) for x in 0.5 * (s1[1:] + s1[:-1])])
    more = [0] + [s1[1] * (0.5 * (f[1:k + 1] + f[:k]) * K[:k][::-1]).sum() for k in range(1, m + 1)]
    theory = np.interp(t, s, u) + np.interp(t, s1, more)
    error = v[1:] / theory[1:] - 1
    for x in (0.1, 0.2, 0.5, 1, 2, 5, 10, 20):
        if x > 1.01 * t[-1]:
            break
        i = np.argmin(abs(t - x)) - 1
        print("    nu t/a^2 = %5.1f: velocity over Stokes' %.4f, error %.2f %%" % (
            x, v[i + 1] / (2 / 9 * 0.002), 100 * error[i]), file=sys.stderr)
    return abs(error[t[1:] > 0.999 * fromTime]).max()


def filmSpeed(arrangement, without, file):
    """Largest difference of the speed of approach of two fibres (times and gaps in a file)
    from their force over the resistance of the mesh (from the file of a run without films)
    and of the film together. Prints each to stderr."""
    d, r, R, mu, force, overlap = 0.37, 0.185, 0.25, 20, 300, 3

    def film(g):
        if arrangement == "crossed":
            return 6 * np.pi * mu * r**2 * (1 / g - 1 / R - (R - g) / R**2)
        t = np.linspace(-0.8, 0.8, 40001)
        x = np.hypot(2 * r + g, t)
        gap = x - 2 * r
        k = np.where(gap < R, (1 / gap**2 - 1 / R**2) / x, 0)
        return 3 * mu * r**2 * k.sum() * (t[1] - t[0]) * overlap

    def speed(name):
        t, g = np.loadtxt(name, skiprows=1).T
        return d * 0.5 * (g[1:] + g[:-1]), -d * np.diff(g) / np.diff(t)

    g0, v0 = speed(without)
    g, v = speed(file)
    worst, n = 0, 0
    for gap, here in zip(g, v):
        if not 0.01 * d < gap < 0.5 * d or gap < g0.min():
            continue
        mesh = force / np.interp(gap, g0[::-1], v0[::-1])
        worst, n = max(worst, abs(here * (mesh + film(gap)) / force - 1)), n + 1
        print("    gap %.3f d: speed %.4f, mesh alone %.4f, both %.4f" % (
            gap / d, here, force / mesh, force / (mesh + film(gap))), file=sys.stderr)
    return worst if n > 8 else np.nan


def capsuleWithCore(file, kappa: float):
    """Largest departure of D of a capsule in a strain (Ca 0.01, G 1, K 3, rate of shear 0.01) with a
    rigid core of radius kappa from the linear theory below, after t Gs/(mu a) = 2. Prints
    some to stderr."""
    d = np.loadtxt(file)
    t, D = d[:, 0] / 0.01, d[:, 7] / 0.01
    theory = coreDeformation(t, kappa)
    for x in (1, 2, 5, 10, 20):
        i = np.argmin(abs(t - x))
        if x > 1.01 * t[-1]:
            break
        print("    t Gs/(mu a) = %4.1f: D/Ca %.4f, theory %.4f" % (t[i], D[i], theory[i]), file=sys.stderr)
    return "%.4f" % abs(D[1:] / theory[1:] - 1)[t[1:] > 1.99].max()


def coreDeformation(t, kappa, G=1.0, K=3.0):
    """D/Ca at times t of a spherical membrane of shear and area moduli G and K about a
    rigid core of radius kappa, to first order in the strain."""
    # Stokes flow u = f(r) q n + g(r) E.n, q = n.E.n, with pressure p q, mu = 1: the strain itself,
    # the stresslet, the potential flow, and the one with pressure inside. f, g, f', g', p
    flows = [lambda r: (0, r, 0, 1, 0),
             lambda r: (r**-2, 0, -2 * r**-3, 0, 2 * r**-3),
             lambda r: (-5 * r**-4, 2 * r**-4, 20 * r**-5, -8 * r**-5, 0),
             lambda r: (-2 * r**3, 5 * r**3, -6 * r**2, 15 * r**2, 21 * r**2)]

    # Radial part (times q) and potential of the tangential part (times grad q)
    def velocity(i, r):
        f, g = flows[i](r)[:2]
        return np.array([f + g, g / 2])

    def traction(i, r):
        f, g, fr, gr, p = flows[i](r)
        h, hr = (f + g) / r, (fr + gr) / r - (f + g) / r**2
        normal, along = -p + fr - f / r + hr * r, gr - g / r + 2 * h
        return np.array([normal + along, along / 2])

    # Force on the fluid of a sphere displaced by w q n + phi grad q
    def elastic(w, phi):
        area = -6 * phi + 2 * w
        return np.array([-2 * K * area, (K - G) * area + 2 * G * (w - 5 * phi)])

    def membraneVelocity(w, phi, E):
        inner = [0, 1, 2, 3] if kappa else [0, 3]
        rows, right = [], []
        for of, load in ((velocity, 0), (traction, elastic(w, phi))):
            columns = [of(1, 1), of(2, 1)] + [-of(i, 1) for i in inner]
            for c in (0, 1):
                rows.append([x[c] for x in columns])
                right.append(-E * of(0, 1)[c] - (load[c] if of is traction else 0))
        for c in (0, 1) if kappa else ():
            rows.append([0, 0] + [velocity(i, kappa)[c] for i in inner])
            right.append(0)
        s = np.linalg.solve(rows, right)
        return E * velocity(0, 1) + s[0] * velocity(1, 1) + s[1] * velocity(2, 1)

    drive = membraneVelocity(0, 0, 1)
    A = np.stack([membraneVelocity(1, 0, 0), membraneVelocity(0, 1, 0)], 1)
    values, vectors = np.linalg.eig(A)
    start = np.linalg.solve(vectors, drive)
    return np.array([0.5 * (vectors @ (start * np.expm1(values * x) / values))[0] for x in t])
