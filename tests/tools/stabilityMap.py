"""Cells of the map of time steps (tests/bench/stabilityMap): runs by map, row, scheme and step.

A folder <map>/<row> has runs <scheme>.<step> and their references: reference (explicit motion
within half its limit), without (the same without the near field, which penalty motion has
not) or referenceRigid.

A verdict is one of
    accurate    the error is below 1 %
    fair        below 10 %
    off         more, or a warning of what has gone wrong
    stopped     the run has not ended
    noReference the reference has not ended
"""
import csv
import os
import re
import numpy as np
import stability
from deformablebodies.tables import records

MAPS = {"stiffness": "Ca_G", "bending": "E_B/(a^2 Gs)", "viscosity": "viscosity ratio", "area": "Skalak C",
        "inertia": "Re", "density": "density ratio"}
SCHEMES = ("default", "explicit", "penalty", "once")
ERRORS = ("error", "fromQuarter", "atEnd")
NUMBERS = ("dt", "limit", "stated", "referenceDt", *ERRORS)
COLUMNS = ("map", "row", "scheme", "dt", "limit", "allowed", "verdict", *ERRORS, "stated", "retries", "referenceDt", "why")


def errors(run, reference):
    """Largest differences from the reference, relative: in the second half of the time, from
    its quarter on, at its end. Of D; of rigid bodies, of the angular velocity, or of the height
    (relative to a tenth of a radius at least)."""
    columns = [("D", 0)]
    if run.groups("angularVelocityZ"):
        columns = [("angularVelocityZ", 0), ("y", max(0.1, abs(reference.series("y")[1]).max()))]
    return [max(stability.apart(run, reference, *c, start)[0] for c in columns) for start in (0.5, 0.25, 1)]


def stated(text):
    """Part of the step in the errors that a log expects; not a number where it has none."""
    found = re.search(r"; step ([\d.e-]+) % ", text)
    return float(found[1]) / 100 if found else np.nan


def told(run, reference):
    """Warnings of a run that its reference has not, but those of a limit that its table
    states."""
    kind = lambda text: re.sub(r"[-+\d.e]+", "#", text.split(" at line ")[-1])
    known = {kind(w) for w in reference.warnings}
    return [w for w in run.warnings if kind(w) not in known and "exceeds the estimated limit" not in w
            and "the largest for the stability" not in w]


def cell(folder, reference, scheme, dt):
    """A row of the table."""
    run = stability.Run(folder)
    limit = stability.promised(run.text)
    row = dict(scheme=scheme, dt=dt, limit=limit, allowed=int(dt <= limit * (1 + 1e-6)),
               stated=stated(run.text), retries=run.retries, why="", **dict.fromkeys(ERRORS, np.nan))
    if not run.ended:
        return dict(row, verdict="stopped", why=run.error or "no end")
    if not reference.ended:
        return dict(row, verdict="noReference", why=reference.error)
    row.update(zip(ERRORS, errors(run, reference)))
    warnings = told(run, reference)
    off = warnings or not row["error"] < 0.1
    row["verdict"] = "off" if off else "fair" if row["error"] >= 0.01 else "accurate"
    row["why"] = warnings[0].split(" at line ")[-1].split(" ", 1)[-1] if warnings else ""
    return row


def table(folder, file):
    """The file of all cells in a folder; returns lines of those within the limits of the log that
    are more than 10 % off or have stopped."""
    rows = []
    for name, row, references, runs in cells(folder):
        for scheme, dt in runs:
            reference = references["without" if scheme == "penalty" else "reference"]
            found = cell("%s/%s/%s/%s.%s" % (folder, name, row, scheme, dt), reference, scheme, float(dt))
            rows.append(dict(found, map=name, row=row, referenceDt=largest(reference)))
    with open(file, "w") as f:
        f.write("# Errors of one body in shear at rate t = 1 to 2, against a reference of a short step, by map,\n"
                "# row, scheme and rate deltaT; see doc/stability.md. Made by tests/bench/stabilityMap\n")
        out = csv.DictWriter(f, COLUMNS, lineterminator="\n")
        out.writeheader()
        out.writerows(dict(r, **{c: "%.3g" % r[c] for c in NUMBERS},
                           why=r["why"].replace(",", ";")[:100]) for r in rows)
    return "\n".join(line(r) for r in rows if isHole(r))


def isHole(row):
    return int(row["allowed"]) and not float(row["error"]) < 0.1


def count(file):
    """Number of cells."""
    return len(records(file))


def holes(file, most: float):
    """Number of cells within the limits of the log, at steps up to the most, that have stopped
    or are more than 10 % off without a warning."""
    return sum(isHole(r) and float(r["dt"]) <= most and (r["verdict"] == "stopped" or not r["why"])
               for r in records(file))


def cells(folder):
    """Map, row, references and pairs of scheme and step that have ended."""
    for name in MAPS:
        for row in sorted(os.listdir(folder + "/" + name), key=float) if os.path.isdir(folder + "/" + name) else ():
            here = "%s/%s/%s" % (folder, name, row)
            ended = [d for d in os.listdir(here) if os.path.exists("%s/%s/status" % (here, d))]
            references = {d.replace("Rigid", ""): stability.Run(here + "/" + d) for d in ended if "." not in d}
            runs = [d.split(".", 1) for d in ended if "." in d]
            yield name, row, references, sorted(runs, key=lambda r: (SCHEMES.index(r[0]), float(r[1])))


def largest(run):
    return run.steps[-1][1] if run.steps else np.nan


def line(row):
    return "    %(map)s %(row)s, %(scheme)s, deltaT %(dt)g (limit %(limit).3g): %(verdict)s, error %(error).3g, at the end %(atEnd).3g, stated %(stated).2g; " \
        "%(why).100s" % row
