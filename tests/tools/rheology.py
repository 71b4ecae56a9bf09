"""Points of the study of suspensions (tests/validation/rheology), in the folder of a run."""
import glob
import re
import numpy as np
from dat import Table


def pieces(pattern):
    """Tables of all pieces of the run, by the time at which they start."""
    return [Table(f) for f in sorted(glob.glob(pattern), key=lambda f: float(f.split("/")[-2]))]


def averages():
    """Last row of averages.dat by column."""
    last = pieces("postProcessing/bulkStress/*/averages.dat")[-1]
    return dict(zip(last.names, last.rows[-1]))


def lines():
    """bulkStress.dat of all pieces of the run, names and rows."""
    tables = pieces("postProcessing/bulkStress/*/bulkStress.dat")
    return tables[0].names, np.vstack([t.rows for t in tables])


def samples():
    """Rows of the bodies of all pieces of the run that are no nuclei, and their names."""
    tables = pieces("postProcessing/bodies/*/cells.dat") or pieces("postProcessing/bodies/*/fibres.dat")
    return tables[0].names, np.vstack([t.rows for t in tables])


def sceneEntry(name):
    """A number of constant/scene."""
    return float(re.search(r"^%s\s+([-\d.e]+)" % name, open("constant/scene").read(), re.M)[1])


def seconds():
    """Seconds of the processor of all pieces."""
    return sum(float(re.findall(r"ExecutionTime = (\S+)", open(f).read())[-1]) for f in glob.glob("log.run.*"))


def row(name):
    """A line of the table."""
    a = averages()
    names, rows = samples()
    late = rows[rows[:, 0] > a["from"]]
    mean = lambda column: late[:, names.index(column)].mean() if column in names else np.nan
    if "D" in names:
        D, angle = mean("D"), mean("inclination")
    else:
        x, y = (late[:, names.index("axis" + d)] for d in "XY")
        D, angle = mean("endToEnd"), np.degrees(np.arctan2(np.abs(y), np.abs(x))).mean()
    fraction = sceneEntry("fraction" if "D" in names else "nL3")
    contacts = a.get("contacts", 0) + a.get("wallContacts", 0)
    values = [fraction, a["relativeViscosity"], a["relativeViscosityError"], a["N1"], a["N1Error"], a["N2"], a["N2Error"],
              a["particleStress"] - contacts, contacts, a["reynoldsStress"], D, angle, seconds()]
    return name + "," + ",".join("%.5g" % v for v in values)


def kept():
    """Largest change of the volume of capsules, over it; of the length of a segment of fibres."""
    names, rows = samples()
    if "volume" in names:
        return "%.2e" % abs(rows[:, names.index("volume")] - 1).max()
    return "%.2e" % abs(rows[:, names.index("lengthError")]).max()


def keptLimit():
    """1e-4 of a volume, 1e-10 of a length."""
    return 1e-4 if "volume" in samples()[0] else 1e-10


def residual():
    """Mean of what the budget does not explain over the mean stress, after the transient."""
    names, rows = lines()
    late = rows[rows[:, 0] > averages()["from"]]
    of = lambda column: late[:, names.index(column)].mean()
    return "%.2e" % abs(of("residual") / of("relativeViscosity"))
