"""Tests of the modules in this folder: a function a claim. Prints a line for each and the
count; the exit status is that of the count."""
import contextlib
import io
import itertools
import os
import sys
import tempfile
import numpy as np
import call
import dat
import distances
import fields
import memory
import places
import scenes
import stability
import stabilityMap
import theory
import vtp
from deformablebodies import Case, Table
from deformablebodies.tables import meanAndError, records


def near(a, b, tolerance=1e-12):
    assert np.all(np.abs(np.asarray(a, float) - b) <= tolerance), (a, b)


def refuses(error, function, *arguments):
    try:
        function(*arguments)
    except error:
        return
    raise AssertionError("%s%s goes on" % (function.__name__, arguments))


def file(name, text):
    mode = "wb" if isinstance(text, bytes) else "w"
    with open(name, mode) as f:
        f.write(text)
    return name


def picture(name, points, lines=(), polygons=()):
    """A file .vtp as the solver writes it, in ASCII."""
    def cells(kind, rows):
        ends = np.cumsum([len(r) for r in rows])
        return "<%s><DataArray type='Int64' Name='connectivity'>%s</DataArray><DataArray type='Int64' " \
            "Name='offsets'>%s</DataArray></%s>" % (kind, " ".join(str(i) for r in rows for i in r),
                                                   " ".join(map(str, ends)), kind)
    return file(name, "<VTKFile type='PolyData' version='1.0'><PolyData><Piece NumberOfPoints='%d' NumberOfLines='%d' "
                "NumberOfPolys='%d'><Points><DataArray type='Float64' NumberOfComponents='3'>%s</DataArray></Points>%s%s"
                "<PointData><DataArray type='Float64' Name='body'>%s</DataArray></PointData></Piece></PolyData></VTKFile>"
                % (len(points), len(lines), len(polygons), " ".join("%.17g" % x for p in points for x in p),
                   cells("Lines", lines), cells("Polys", polygons), " ".join("0" for p in points)))


def cubes(name, *corners, side=1):
    """A picture of cubes of squares, from their lowest corners."""
    unit = np.array(list(itertools.product((0, 1), repeat=3)))
    squares = ((0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3))
    return picture(name, [p for c in corners for p in side * unit + c],
                   polygons=[[8 * k + i for i in s] for k in range(len(corners)) for s in squares])


bodies = "# time body x\n# [s] [number] [m]\n%g 0 %.17g\n%g 1 %.17g\n"


def columnsOfTablesHaveNamesAndUnits():
    table = Table(file("a.dat", bodies % (0.1, 2, 0.1, 3)))
    near(table["x"], [2, 3])
    assert table.units["x"] == "m" and "x" in table and "y" not in table
    refuses(KeyError, lambda: table["y"])
    near(table.of(1)["x"], [3])
    near(table.after(0.1).rows.size, 0)
    near(Table(file("empty.dat", "# a b\n")).rows.shape, (0, 2))


def laterPiecesOfARunReplaceTheirTimes():
    pieces = [file("%d.dat" % n, "# t x\n" + rows) for n, rows in enumerate(("0 1\n1 2\n2 3\n", "", "1.5 7\n2 8\n"))]
    near(Table.joined(pieces)["x"], [1, 2, 7, 8])


def casesHaveEntriesAndPiecesInTheOrderOfTheirStarts():
    os.makedirs("case/constant", exist_ok=True)
    file("case/constant/scene", "Re   0.1; // number\nbody  sphere;\nReal 5;\n")
    for start in ("0", "10", "9.5"):
        os.makedirs("case/postProcessing/bodies/" + start, exist_ok=True)
        file("case/postProcessing/bodies/%s/cells.dat" % start, bodies % (float(start), 1, float(start), 2))
    case = Case("case")
    near(case.entry("Re"), 0.1)
    assert case.entry("body") == "sphere" and case.entry("R") is None
    near(case.bodies("cells", 0)["time"], [0, 9.5, 10])
    near(Table(case.latest("bodies", "cells.dat"))["time"], [10, 10])
    refuses(KeyError, case.bodies, "others")
    refuses(KeyError, case.bodies, "cells", 5)
    refuses(FileNotFoundError, case.stress)


def recordsLeaveCommentsOut():
    rows = records(file("a.csv", "# from a paper\nx,y\n1,two\n"))
    assert rows == [{"x": "1", "y": "two"}]


def differencesAreRelativeToTheLargestValue():
    a, b = file("a.dat", bodies % (0.1, 2, 0.1, 4)), file("b.dat", bodies % (0.1, 2, 0.1, 4.0004))
    near(dat.difference(a, b), 1e-4, 1e-15)
    near(dat.difference(a, a), 0)


def smallColumnsCountAbsolutelyButInTables():
    a, b = file("a.dat", "0 0 1e-3\n1 1 1e-3\n"), file("b.dat", "0 0 1e-3\n1 1 2e-3\n")
    near(dat.difference(a, b), 1e-3, 1e-15)
    near(dat.difference(a, b, "table"), 1, 1e-12)


def runsThatBrokeOffDoNotAgree():
    a, b = file("a.dat", bodies % (0.1, 2, 0.1, 4)), file("b.dat", bodies % (0.1, 2, 0.2, 4))
    assert np.isnan(dat.difference(a, b))


def bodiesAndTimesThatAreLostAreNoAgreement():
    rows = ["%g %d 1" % (t, body) for t in (0.1, 0.2, 0.3) for body in (0, 1)]
    whole = file("a.dat", "\n".join(rows))
    for lost in (1, 2, 3, 5):
        part = file("b.dat", "\n".join(rows[:lost] + rows[lost + 1:]))
        assert np.isnan(dat.difference(whole, part)) and np.isnan(dat.difference(part, whole))
    near(dat.difference(whole, file("b.dat", "\n".join(rows[2:]))), 0)
    rows = ["%g 1" % t for t in (0.1, 0.2, 0.3)]
    whole = file("a.dat", "\n".join(rows))
    assert np.isnan(dat.largestDifference(whole, file("b.dat", rows[0] + "\n" + rows[2])))
    near(dat.largestDifference(whole, file("b.dat", "\n".join(rows[1:]))), 0)


def fieldsAreTheSameInBothFormats():
    values = np.arange(12.).reshape(4, 3) / 7
    header = "FoamFile { format %s; class volVectorField; }\ninternalField   nonuniform List<vector> \n4\n("
    file("ascii", header % "ascii" + "\n".join("(%.17g %.17g %.17g)" % tuple(v) for v in values) + "\n);")
    file("binary", (header % "binary").encode() + values.tobytes() + b");")
    near(fields.field("ascii"), values, 0)
    near(fields.field("binary"), values, 0)
    near(fields.difference("ascii", "binary"), 0)
    near(fields.rmsDifference("ascii", "binary"), 0)
    near(fields.resultant("ascii"), values.sum(0).max() / values.max(), 5e-3)


def linesComeInTheirOrder():
    x = np.array([(0, 0, 0), (1, 0, 0), (2, 1, 0), (0, 0, 5), (0, 1, 5)])
    lines = vtp.lines(picture("lines.vtp", x, lines=[(0, 1, 2), (4, 3)]))
    near(lines[0], x[:3])
    near(lines[1], x[[4, 3]])


def surfacesComeApart():
    parts = vtp.bodies(cubes("cubes.vtp", (0, 0, 0), (3, 0, 0), (0, 5, 0)))
    assert sorted(p.GetBounds()[::2] for p in parts) == [(0, 0, 0), (0, 5, 0), (3, 0, 0)]
    assert [p.GetNumberOfPoints() for p in parts] == [8, 8, 8]


def segmentsMeetBetweenEndsOrAtThem():
    at = lambda *v: np.array(v, float)
    d = lambda p, q, r, s: float(distances.segments(at(*p), at(*q), at(*r), at(*s)))
    near(d((-1, 0, 0), (1, 0, 0), (0, -1, 0.3), (0, 1, 0.3)), 0.3)
    near(d((-1, 0, 0), (1, 0, 0), (0, 2, 0), (0, 3, 0)), 2)
    near(d((-1, 0, 0), (1, 0, 0), (2, 1, 0), (3, 1, 0)), 2**0.5)
    near(d((0, 0, 0), (1, 0, 0), (0, 1, 0), (1, 1, 0)), 1)
    near(d((0, 0, 0), (0, 0, 0), (3, 4, 0), (3, 4, 0)), 5)


def segmentsAreAsNearAsAllTheirPoints():
    random = np.random.default_rng(3)
    s = np.linspace(0, 1, 201)[:, None]
    for _ in range(50):
        p, q, r, t = random.normal(size=(4, 3))
        a, b = p + s * (q - p), r + s * (t - r)
        brute = np.linalg.norm(a[:, None] - b[None], axis=-1).min()
        d = float(distances.segments(p, q, r, t))
        assert d <= brute + 1e-12 and brute - d < 0.03, (d, brute)


def linesAreNearAcrossPeriodicSides():
    a, b = np.array([(-3.9, 0, 0), (-3.9, 1, 0)]), np.array([(3.8, 0, 0), (3.8, 1, 0)])
    box = np.array([8, 1e300, 8])
    near(distances.closestLines([a, b], box), 0.3)
    near(distances.closestLines([a, b + (0, 1.2, 0)], box), np.hypot(0.3, 0.2))
    picture("up.vtp", a, lines=[(0, 1)])
    picture("down.vtp", b, lines=[(0, 1)])
    near(distances.closest(8, "up.vtp,down.vtp"), 0.3)
    near(distances.closest("8,3,8", "up.vtp,down.vtp"), 0.3)
    assert distances.closest(8) == "nan"


def aLineMeetsItself():
    t = np.linspace(0, 1, 50)[:, None]
    there = np.hstack([3 * t, 0 * t, 0 * t])
    x = np.vstack([there, [[3, 0.2, 0]], there[::-1] + (0, 0.2, 0)])
    near(distances.ownParts(x, 1), 0.2, 1e-3)
    near(distances.ownParts(there, 1), 1, 0.01)


def pointsWithinOthersAreCounted():
    assert distances.enclosed(cubes("apart.vtp", (0, 0, 0), (1.5, 0, 0))) == 0
    assert distances.enclosed(cubes("over.vtp", (0, 0, 0), (0.5, 0.5, 0.5))) == 2
    assert np.isnan(distances.enclosed(cubes("one.vtp", (0, 0, 0))))


def surfacesThatCrossAreFoundThroughPeriodicSides():
    pairs = lambda shift, *corners: distances.crossingPairs(vtp.bodies(cubes("c.vtp", *corners)), 8, shift)
    assert pairs(0, (0, 0, 0), (1.5, 0.1, 0.1)) == 0
    assert pairs(0, (0, 0, 0), (0.5, 0.1, 0.1)) == 1
    assert pairs(0, (-4, 0, 0), (3.5, 0.1, 0.1)) == 1
    assert pairs(0.7, (0, 0, 0), (1.5, 0.1, 0.1)) + pairs(0.7, (1.5, 0.1, 0.1), (0, 0, 0)) == 1


def depthsHaveASign():
    surface = vtp.read(cubes("cube.vtp", (0, 0, 0), side=2))
    near(distances.beyond(surface, [(1, 1, 1.5)]), -0.5)
    near(distances.beyond(surface, [(1, 1, 1.5), (1, 1, 2.25)]), 0.25)


def placesAreReadAndMeasured():
    file("places", "positions ((0 0 0)\n(0 3 3.5)\n);\ndirections ((0 0 1)\n(1 0 0)\n);\n")
    assert places.number("places") == 2
    near(places.highest("places"), 3)
    near(places.least("places", 8), np.hypot(3, 3.5))
    near(places.least("places", 8, 3), np.hypot(3, 0.5))
    near(places.offZ("places"), 1)


def fibresStayFromWalls():
    file("places", scenes.scattered(40, 4, 4, 4, 1, 0.5))
    x, t = places.read("places")
    near(np.linalg.norm(t, axis=1), 1, 1e-8)
    assert len(x) == 40 and abs(x[:, 1]).max() <= 2.5 and 3 < abs(x[:, 0]).max() <= 4


def surfacesOfFilesAreClosed():
    for text, count in ((scenes.octahedron(-1), 8), (scenes.ellipsoid(4), 48), (scenes.bowTie(), 8)):
        vertices = [line.split(None, 1)[1] for line in text.splitlines() if line.startswith("vertex")]
        edges = [(a, b) for k in range(0, len(vertices), 3)
                 for a, b in zip(vertices[k:k + 3], vertices[k + 1:k + 3] + vertices[k:k + 1])]
        assert len(vertices) == 3 * count and sorted(edges) == sorted((b, a) for a, b in edges)


def oneTriangleIsTurned():
    assert sum(a != b for a, b in zip(scenes.octahedron(-1).splitlines(), scenes.octahedron(3).splitlines())) == 2


def spheresResistAsInTables():
    # Brenner 1961, Goldman, Cox & Brenner 1967
    near(theory.sphereResistance("towards", np.cosh(1) - 1), 3.0361, 1e-3)
    near(theory.sphereResistance("along", 0.5431), 1.5675, 0.01)
    near(theory.sphereResistance("spheres", 1e3), 1, 2e-3)


def sparseArraysSettleAsOneSphere():
    near(theory.hasimoto(0), 1)
    near(theory.hasimoto(0.001), 1 - 0.17601 + 0.001, 1e-5)


def cylindersAreTheirOwnInverse():
    radius, side = 0.5, 8
    c = np.pi * radius**2 / side**2
    drag = 4 * np.pi / (-0.5 * np.log(c) - 0.738168 + c - 0.887 * c * c)
    near(theory.cylinderRadius(drag, side, 0), radius, 1e-4)


def capsulesGoToTheSameDWithAndWithoutACore():
    # 25/12 Ca of a neo-Hookean membrane (Barthes-Biesel & Rallison 1981)
    for kappa in (0, 0.5):
        near(theory.coreDeformation(np.array([1e3]), kappa), 25 / 12, 1e-9)


def stabilityRun(folder, column, end="End", warning="", Courant="0.1", dt=1.0):
    """Folder of a run of ten steps of one body with this column of y."""
    os.makedirs(folder + "/postProcessing/bodies/0")
    file(folder + "/postProcessing/bodies/0/c.dat", "# time body x y z volume\n" + "".join(
        "%g 0 0 %.9g 0 1\n" % (i * dt, y) for i, y in enumerate(column)))
    file(folder + "/log.run", "Create time\nCourant Number max: 0.1\nLimits of the time step (deltaT is %g, fixed)\n"
         "    flow        2.5 s, x\n    diffusion   none, y\n\n%s" % (dt, warning) + "".join(
             "Time = %g\n\nCourant Number max: %s\nExecutionTime = %g s\n" % (i * dt, Courant, i)
             for i in range(1, len(column))) + end + "\n")
    file(folder + "/status", "0" if end == "End" else "1")
    file(folder + "/dt", "%g" % dt)


def verdictOf(column, **words):
    line = np.linspace(0, 0.1, 11)
    with tempfile.TemporaryDirectory() as folder:
        stabilityRun(folder + "/reference", line)
        stabilityRun(folder + "/fixed", column, **words)
        file(folder + "/fixed.dt", open(folder + "/fixed/dt").read())
        out = io.StringIO()
        with contextlib.redirect_stdout(out):
            stability.judge("a/b", folder, "fixed", 10, 0.5, "y", "0.02", "1")
    return out.getvalue().rstrip("\n").split("\t")


def campaignJudgesRuns():
    line = np.linspace(0, 0.1, 11)
    good = verdictOf(line)
    assert good[11:13] == ["ok", "0"] and good[2:5] == ["1", "2.5", "10"], good
    off = verdictOf(line + 0.05 * (line > 0.05))
    assert off[11:13] == ["WRONG", "1"] and abs(float(off[10]) - 0.05) < 1e-9, off
    said = "--> FOAM Warning :\n    reduce deltaT\n\n"
    assert verdictOf(line + 0.05, warning=said)[11:13] == ["warned", "1"]
    # A step above the limit that was said to be so
    assert verdictOf(line + 0.05, warning=said, dt=3)[11:13] == ["warned", "0"]
    assert verdictOf(np.r_[line[:-1], 0.3])[13].startswith("c jumps")
    assert verdictOf(line * np.nan)[11] == "WRONG"
    assert "times as fast" in verdictOf(line, Courant="0.9")[13]
    stop = "--> FOAM FATAL ERROR: \n%s\n\n    From function x\n\nFOAM exiting"
    assert verdictOf(line, end=stop % "body 3 of c left: reduce deltaT")[11] == "stopped"
    assert verdictOf(line, end=stop % "it went wrong")[11] == "unclear"
    assert verdictOf(line, end="")[11] == "broken"


def mapRun(folder, D, **words):
    stabilityRun(folder, D, **words)
    file(folder + "/postProcessing/bodies/0/c.dat", "# time body D\n" + "".join(
        "%g 0 %.9g\n" % (i, d) for i, d in enumerate(D)))


def cellsOfTheMapAreJudgedInTheSecondHalf():
    line = np.linspace(0, 0.1, 11)
    with tempfile.TemporaryDirectory() as folder:
        here = folder + "/stiffness/0.1/"
        said = "--> FOAM Warning :\n    %s\n\n"
        for name, D, words in (
                ("reference", line, dict(warning=said % "known: 3")),
                ("default.0.1", line * np.r_[2, 2, 2, 2, 2, 1, 1, 1, 1, 1, 1], dict(warning=said % "known: 4")),
                ("default.0.2", line * 1.05, {}), ("default.0.4", line * 1.2, {}),
                ("default.0.8", line * 1.001, dict(warning=said % "change of volume")),
                ("explicit.0.1", line * 1.001, dict(warning=said % "exceeds the estimated limit of x")),
                ("explicit.0.2", line * np.nan, {}), ("explicit.3", line[:4], dict(end=""))):
            mapRun(here + name, D, **words)
        said = stabilityMap.table(folder, folder + "/map.csv").split("\n")
        rows = stabilityMap.records(folder + "/map.csv")
        holes = [stabilityMap.holes(folder + "/map.csv", dt) for dt in (0.1, 0.2, 0.4, 3)]
        assert stabilityMap.count(folder + "/map.csv") == len(rows)
    assert [r["verdict"] for r in rows] == ["accurate", "fair", "off", "off", "accurate", "off", "stopped"], rows
    assert [r["allowed"] for r in rows] == list("1111110"), rows
    near([float(rows[0][e]) for e in stabilityMap.ERRORS], [0, 0.4, 0])
    near([float(rows[1][e]) for e in stabilityMap.ERRORS], 0.05)
    assert len(said) == 2 and "deltaT 0.4" in said[0] and "explicit, deltaT 0.2" in said[1], said
    assert holes == [0, 1, 2, 2], holes


def fluctuationsLeaveOutTheMeanOfPlanes():
    with tempfile.TemporaryDirectory() as folder:
        os.makedirs(folder + "/constant")
        os.makedirs(folder + "/1")
        file(folder + "/constant/scene", "cells   2;\n")
        U = np.zeros((2, 3, 2, 3))
        U[:, :, :, 0] = np.arange(3)[None, :, None]
        U[0, :, :, 1], U[1, :, :, 1] = 1, -1
        file(folder + "/1/U", "format ascii;\ninternalField nonuniform List<vector> 12\n%s;\n"
             % scenes.rows(U.reshape(-1, 3)))
        t, v = stability.fluctuations(folder)
        assert t[0] == 1
        near(v, 1)


def noiseIsWithinItsAmplitude():
    U = np.arange(12.).reshape(4, 3)
    file("U", "format binary;\ninternalField nonuniform List<vector> 4\n".encode() + b"(" + U.tobytes()
         + b");\nboundaryField { }\n")
    fields.addNoise("U", 0.1)
    V = fields.field("U")
    assert 0.01 < abs(V - U).max() < 0.1


def errorsOfSeriesKnowThatTheyFollow():
    # Noise that each value keeps 0.98 of: its mean has 10 times the error of as many free ones
    random, x = np.random.default_rng(5), [0.0]
    for noise in random.normal(size=20000):
        x.append(0.98 * x[-1] + np.sqrt(1 - 0.98**2) * noise)
    mean, error = meanAndError(3 + np.array(x), np.ones(len(x)))
    assert abs(mean - 3) < 4 * error and 0.05 < error < 0.15, (mean, error)
    mean, error = meanAndError(np.array([1.0, 3.0] * 500), np.array([3.0, 1.0] * 500))
    near(mean, 1.5)


def programsTakeMemory():
    assert memory.largest(sys.executable, "-c", "x = bytearray(200000000)") > 2e8


def callsConvertAndPrint():
    out = io.StringIO()
    with contextlib.redirect_stdout(out):
        call.main("theory.hasimoto", "0")
        call.main("scenes.octahedron", "3")
    lines = out.getvalue().splitlines()
    assert lines[0] == "nan" or float(lines[0]) == 1
    assert lines[1] == "solid surface"
    assert call.text((1, 0.5, "a")) == "1 0.5 a" and call.text(np.float64(1 / 3)) == "0.333333"
    refuses(AttributeError, call.main, "dat.nothing")


def main():
    tests = [f for f in list(globals().values())
             if getattr(f, "__module__", "") == __name__ and f.__code__.co_argcount == 0 and f is not main]
    tests = [f for f in tests if not f.__code__.co_flags & 4]
    failed = 0
    for test in tests:
        with tempfile.TemporaryDirectory() as folder:
            os.chdir(folder)
            try:
                test()
                print("pass: " + test.__name__)
            except Exception as error:
                failed += 1
                print("FAIL: %s: %s: %s" % (test.__name__, type(error).__name__, error))
            os.chdir("/")
    print("%d passed, %d failed" % (len(tests) - failed, failed))
    sys.exit(failed > 0)


main()
