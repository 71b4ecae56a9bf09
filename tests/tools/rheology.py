"""Points of the study of suspensions (tests/validation/rheology), in the folder of a run."""
import glob
import re
import numpy as np
import distances
from deformablebodies import Case
from deformablebodies.tables import meanAndError, records, timeWeights

case = Case()


def samples():
    """Samples of the bodies that are no nuclei."""
    return case.bodies(next(group for group in ("cells", "fibres") if case.pieces("bodies", group + ".dat")))


def seconds():
    """Seconds of the processor of all pieces."""
    return sum(float(re.findall(r"ExecutionTime = (\S+)", open(f).read())[-1]) for f in glob.glob("log.run.*"))


def isSteady():
    """yes where the run found at its end that the transient is over."""
    return "yes" if case.averages() else "no"


def ofBodies(times, values):
    """Mean over bodies and time, and its error."""
    once, of = np.unique(times, return_inverse=True)
    return meanAndError(np.bincount(of, values) / np.bincount(of), timeWeights(once))


def row(name):
    """A line of the table."""
    a = case.averages()
    late = samples().after(a["from"])
    if "D" in late:
        shape, angle = late["D"], late["inclination"]
    else:
        shape = late["endToEnd"]
        angle = np.degrees(np.arctan2(np.abs(late["axisY"]), np.abs(late["axisX"])))
    contacts = a.get("contacts", 0) + a.get("wallContacts", 0)
    values = [case.entry("fraction" if "D" in late else "nL3"), a["relativeViscosity"], a["relativeViscosityError"],
              a["N1"], a["N1Error"], a["N2"], a["N2Error"], a["particleStress"] - contacts, contacts,
              a["reynoldsStress"], *ofBodies(late["time"], shape), *ofBodies(late["time"], angle), seconds()]
    return name + "," + ",".join("%.5g" % v for v in values)


def kept():
    """Largest change of the volume of capsules, over it; of the length of a segment of fibres."""
    all_ = samples()
    return "%.2e" % (abs(all_["volume"] - 1) if "volume" in all_ else abs(all_["lengthError"])).max()


def keptLimit():
    """1e-4 of a volume, 1e-10 of a length."""
    return 1e-4 if "volume" in samples() else 1e-10


def met():
    """In the pictures: pairs of capsules whose surfaces cross; half a diameter over the least distance of
    the axes of two fibres."""
    period = 2 * case.entry("half")
    if "volume" in samples():
        return distances.crossing("cells", len(set(samples()["body"])), period)
    files = [file for _, file in case.pictures("fibres")]
    diameter = case.entry("diameter", "constant/deformableBodies")
    return "%.3g" % (0.5 * diameter / float(distances.closest(period, *files)))


def metLimit():
    """No pair of capsules, fibres that keep half a diameter."""
    return 0 if "volume" in samples() else 1


def highest():
    """The indicator of shapes at the end: amplitude of the two highest harmonics over that of all; of fibres 1 -
    cosine of the angle between segments."""
    last = max(glob.glob("log.run.*"), key=lambda f: int(f.rsplit(".", 1)[1]))
    name = "highest harmonics" if "volume" in samples() else "angle between segments"
    return (re.findall(name + r" ([\d.e-]+)", open(last).read()) or ["nan"])[-1]


def residual():
    """Mean of what the budget does not explain over the mean stress, after the transient."""
    late = case.stress().after(case.averages()["from"])
    return "%.2e" % abs(late["residual"].mean() / late["relativeViscosity"].mean())


def points(table):
    """Rows of the table with the parts of their names: kind, Re, nucleus, Ca, fraction of capsules; kind, Re,
    nL3, stiffness, box of fibres. Boxes of another size than that of the study are left out."""
    names = {"capsules": r"(capsules)\.Re([\d.]+)\.(none|rigid)\.Ca([\d.]+?)\.(0\.\d+)",
             "fibres": r"(fibres)\.Re([\d.]+)\.(\d+)\.B([\d.]+?)(\.noLubrication)?"}
    parts = {"capsules": ("kind", "Re", "nucleus", "Ca", "fraction"),
             "fibres": ("kind", "Re", "nL3", "stiffness", "dry")}
    for row in records(table):
        kind = row["point"].split(".")[0]
        found = re.fullmatch(names[kind], row["point"])
        if found:
            numbers = {k: float(v) for k, v in row.items() if k != "point" and v}
            yield {**numbers, **dict(zip(parts[kind], found.groups()))}


def errorsBetween(a, b, quantity):
    """By how many of its errors the difference of two rows is above 0."""
    error = {"viscosity": "error", "D": "Derror", "angle": "angleError"}.get(quantity, quantity + "error")
    return (b[quantity] - a[quantity]) / np.hypot(a[error], b[error])


def neighbours(rows, along, **of):
    """Pairs of rows that follow each other along a part of their names, all other parts equal and among those
    given."""
    parts = [k for k in ("kind", "Re", "nucleus", "Ca", "fraction", "nL3", "stiffness", "dry") if k != along]
    place = lambda r: ("none", "rigid").index(r[along]) if along == "nucleus" else float(r[along])
    groups = {}
    for r in rows:
        if all(r[k] in allowed for k, allowed in of.items()):
            groups.setdefault(tuple(r.get(k) for k in parts), []).append(r)
    for group in groups.values():
        group.sort(key=place)
        yield from zip(group, group[1:])


def boxesAndMeshes(table):
    """Prints what another box or mesh changes: each row whose name ends so beside that of its name without it."""
    rows = {r["point"]: {k: float(v) for k, v in r.items() if k != "point" and v} for r in records(table)}
    for name, other in rows.items():
        found = re.search(r"\.(wide|narrow|fine)$", name)
        own = rows.get(name.replace(found[0], "")) if found else None
        if own:
            change = lambda k, error: "%s %.5g for %.5g (%+.1f errors)" % (k, other[k], own[k], (
                other[k] - own[k]) / np.hypot(other[error], own[error]))
            print("    %s: %s" % (name, ", ".join(change(k, error) for k, error in (
                ("viscosity", "error"), ("N1", "N1error"), ("N2", "N2error"), ("D", "Derror"), ("angle", "angleError"))
                if error in own and error in other)))


def trends(table):
    """Claims of rheology.md, each with what is missing at the worst pair of rows (at most 0: it holds), or none
    where there is no pair."""
    rows = list(points(table))
    capsules, fibres = ([r for r in rows if r["kind"] == kind] for kind in ("capsules", "fibres"))
    known = [r for r in capsules if "Derror" in r]  # errors of D and inclination
    slow, soft = ("0.1", "1"), ("0.3", "0.5")
    stiff = {"nL3": ("10",), "dry": (None,), "Re": ("1", "10")}
    # Text, sign, quantity, pairs, errors that the difference is to have
    claims = (
        ("viscosity of capsules rises with the fraction", 1, "viscosity", neighbours(capsules, "fraction"), 3),
        ("    falls with Ca at Re 0.1 and 1", -1, "viscosity", neighbours(capsules, "Ca", Re=slow), 3),
        ("    falls with Ca at Re 10, without nuclei", -1, "viscosity",
         neighbours(capsules, "Ca", Re=("10",), nucleus=("none",)), 1.5),
        ("    rises with Re", 1, "viscosity", neighbours(capsules, "Re"), 2),
        ("    is raised by nuclei at Re 0.1 and 10, Ca 0.3 and 0.5, 20 and 30 %", 1, "viscosity",
         neighbours(capsules, "nucleus", Re=("0.1", "10"), Ca=soft, fraction=("0.2", "0.3")), 2),
        ("N1 of capsules is lowered by nuclei at Re 0.1 and 1", -1, "N1", neighbours(capsules, "nucleus", Re=slow), 1),
        ("    at Re 10, Ca 0.3, 20 and 30 %", -1, "N1",
         neighbours(capsules, "nucleus", Re=("10",), Ca=("0.3",), fraction=("0.2", "0.3")), 3),
        ("inclination of capsules falls with the fraction at Re 0.1 and 1", -1, "angle",
         neighbours(known, "fraction", Re=slow), 3),
        ("    at Re 10, from 20 to 30 %", -1, "angle",
         neighbours(known, "fraction", Re=("10",), fraction=("0.2", "0.3")), 3),
        ("D of capsules is lowered by nuclei", -1, "D", neighbours(known, "nucleus"), 3),
        ("viscosity of fibres, n L^3 10, Re 1 and 10, falls from stiffness 1 to 0.001 to 0.0001", 1, "viscosity",
         neighbours(fibres, "stiffness", stiffness=("1", "0.001", "0.0001"), **stiff), 3),
        ("N1 of fibres, n L^3 10, is higher at stiffness 0.001 than at 1", -1, "N1",
         neighbours(fibres, "stiffness", stiffness=("1", "0.001"), **stiff), 3))
    missing = [("%s (errors: %g)" % (text, least), [least - sign * errorsBetween(a, b, quantity) for a, b in pairs])
               for text, sign, quantity, pairs, least in claims]
    missing += [("%s of capsules at Re 0.1 and 1 is %s, 3 errors" % (N, word),
                 [3 - sign * r[N] / r[N + "error"] for r in capsules if r["Re"] in slow])
                for N, sign, word in (("N1", 1, "positive"), ("N2", -1, "negative"))]
    missing.append(("D of capsules falls by 5 % and more with nuclei",
                    [b["D"] / a["D"] - 0.95 for a, b in neighbours(capsules, "nucleus")]))
    for text, values in missing:
        print("%s|%s" % (text, "%.3g" % np.max(values) if values else "none"))
