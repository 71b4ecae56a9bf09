"""Points of the study of suspensions (tests/validation/rheology), in the folder of a run."""
import glob
import re
import numpy as np
from deformablebodies import Case

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


def row(name):
    """A line of the table."""
    a = case.averages()
    late = samples().after(a["from"])
    if "D" in late:
        D, angle = late["D"].mean(), late["inclination"].mean()
    else:
        D = late["endToEnd"].mean()
        angle = np.degrees(np.arctan2(np.abs(late["axisY"]), np.abs(late["axisX"]))).mean()
    contacts = a.get("contacts", 0) + a.get("wallContacts", 0)
    values = [case.entry("fraction" if "D" in late else "nL3"), a["relativeViscosity"], a["relativeViscosityError"],
              a["N1"], a["N1Error"], a["N2"], a["N2Error"], a["particleStress"] - contacts, contacts,
              a["reynoldsStress"], D, angle, seconds()]
    return name + "," + ",".join("%.5g" % v for v in values)


def kept():
    """Largest change of the volume of capsules, over it; of the length of a segment of fibres."""
    all_ = samples()
    return "%.2e" % (abs(all_["volume"] - 1) if "volume" in all_ else abs(all_["lengthError"])).max()


def keptLimit():
    """1e-4 of a volume, 1e-10 of a length."""
    return 1e-4 if "volume" in samples() else 1e-10


def residual():
    """Mean of what the budget does not explain over the mean stress, after the transient."""
    late = case.stress().after(case.averages()["from"])
    return "%.2e" % abs(late["residual"].mean() / late["relativeViscosity"].mean())
