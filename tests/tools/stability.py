"""Runs of the campaign of stability: their logs and samples, and verdicts on them.

A verdict is one of
    ok          ended, and within the bound of the reference
    stopped     a stop that names body or place, and what to do
    warned      apart from the reference, and a warning asks for another deltaT or start
    WRONG       apart from the reference, and nothing was said
    unclear     a stop without body, place or remedy
    broken      no end and no error: a signal, a floating point exception
    unfinished  more processor time than a run may take
"""
import glob
import os
import re
import numpy as np
from deformablebodies import Table
import fields

MODES = ("fixed", "between", "limit", "adjusted")


def promised(text):
    """Smallest limit [s] of the first table in a log; infinite without any, or without a
    flow. Not a number where the run stopped before its table."""
    rows = re.search(r"Limits of the time step.*\n((?:    \S.*\n)*)", text)
    if not rows:
        return np.inf if re.search(r"^Time = ", text, re.M) else np.nan
    return min(map(float, re.findall(r"^    \S+ +([\d.e+-]+) s,", rows[1], re.M)), default=np.inf)


def steps(text):
    """Time, length and Courant number of each step in a log, the start included; none
    without a flow."""
    found = []
    time, dt = 0.0, float((re.findall(r"deltaT is ([\d.e+-]+)", text) or ["nan"])[0])
    pattern = r"^(Time = |Courant Number max: |deltaT = )([^\s,]+)"
    for what, value in re.findall(pattern, text, re.M):
        value = float(value)
        if what[0] == "d":
            dt = value
        elif what[0] == "T":
            time = value
        else:
            found.append((time, dt, value))
    return found if "deltaT is" in text else []


class Run:
    """A folder with log.run, status (of its last command) and postProcessing."""

    def __init__(self, folder):
        self.folder = folder
        with open(folder + "/log.run", errors="replace") as f:
            self.text = f.read()
        with open(folder + "/status") as f:
            self.status = int(f.read())
        self.steps = steps(self.text)
        self.number = len(re.findall(r"^Time = ", self.text, re.M))
        self.seconds = sum(float(x) for x in self.lastOfParts(r"ExecutionTime = ([\d.]+) s"))
        self.retries = len(re.findall(r"Step taken back", self.text))
        self.ended = self.status == 0 and bool(re.search(r"^End$", self.text, re.M))
        fatal = re.search(r"FOAM FATAL.*?ERROR:?(.*?)(?:\n    From function|\nFOAM|$)", self.text, re.S)
        self.error = " ".join(fatal[1].split()) if fatal else ""
        self.warnings = [" ".join(w.split()) for w in re.findall(
            r"FOAM Warning :(.*?)(?=\n\n|\n-->|\nTime|\n[A-Z][a-z]+ )", self.text, re.S)]
        self.tables = {}
        for file in sorted(glob.glob(folder + "/postProcessing/bodies/*/*.dat"),
                           key=lambda f: float(f.split("/")[-2])):
            self.tables.setdefault(os.path.basename(file)[:-4], []).append(Table(file))

    def lastOfParts(self, pattern):
        """Last number of each part of a log that several runs have written."""
        parts = re.split(r"^Create time$", self.text, flags=re.M)[1:]
        return [found[-1] for found in (re.findall(pattern, part) for part in parts) if found]

    def largestStep(self):
        times = [0, *map(float, re.findall(r"^Time = (\S+)", self.text, re.M))]
        return np.diff(times).max() if len(times) > 1 else 0

    def groups(self, column):
        return [g for g, tables in self.tables.items() if column in tables[0].names]

    def column(self, group, name):
        """Times, and values of all bodies (times x bodies) of a group."""
        tables = [t for t in self.tables[group] if t.rows.size]
        time, body, value = (np.concatenate([t[n] for t in tables]) for n in ("time", "body", name))
        number = int(body.max()) + 1
        times, which = np.unique(np.round(time, 9), return_inverse=True)
        values = np.full((len(times), number), np.nan)
        values[which, body.astype(int)] = value
        return times, values

    def series(self, name):
        """Times and values of a quantity: [mean:][group:]column, distance (of the first
        two bodies of all groups), fastest (velocity of the flow in cells), or flow (mean square
        of the velocity less its mean over each plane, at the times written)."""
        if name == "flow":
            return fluctuations(self.folder)
        if name == "fastest":
            t, dt, Co = np.array(self.steps).T
            return t, (Co / dt)[:, None]
        if name == "distance":
            places = []
            for group in self.tables:
                xyz = [self.column(group, c) for c in "xyz"]
                t = xyz[0][0]
                places += list(np.stack([v for _, v in xyz], -1).swapaxes(0, 1))
            return t, np.linalg.norm(places[0] - places[1], axis=-1)[:, None]
        mean = name.startswith("mean:")
        group, _, column = name.replace("mean:", "").rpartition(":")
        t, v = self.column(group or self.groups(column)[0], column)
        return t, np.nanmean(v, axis=1, keepdims=True) if mean else v

    def speeds(self):
        """For each group the largest speed of a centre between samples, of each time."""
        for group in self.groups("x"):
            xyz = [self.column(group, c) for c in "xyz"]
            t = xyz[0][0]
            if len(t) > 1:
                x = np.stack([v for _, v in xyz], -1)
                way = np.nan_to_num(np.linalg.norm(np.diff(x, axis=0), axis=-1))
                yield group, t[1:], np.diff(t), way.max(axis=1) / np.diff(t)


def fluctuations(folder):
    """Times written, and mean square of the velocity less its mean over each plane y."""
    times, values = [], []
    with open(folder + "/constant/scene") as f:
        n = int(re.search(r"^cells +(\d+)", f.read(), re.M)[1])
    for file in glob.glob(folder + "/[0-9]*/U"):
        time = file.split("/")[-2]
        if time in ("0", "0.orig"):
            continue
        U = fields.field(file)
        U = U.reshape(n, -1, n, 3)
        times.append(float(time))
        values.append(((U - U.mean(axis=(0, 2), keepdims=True))**2).sum(axis=-1).mean())
    order = np.argsort(times)
    return np.array(times)[order], np.array(values)[order][:, None]


def apart(run, reference, name, scale, start=0.25):
    """Largest difference from the reference after the first quarter of its time, or another
    start, over the largest value of the reference or a scale; and the last values of the body."""
    t, v = run.series(name)
    s, w = reference.series(name)
    late = (t >= start * s[-1] * (1 - 1e-9)) & (t <= s[-1] * (1 + 1e-9))
    if not late.any():
        return np.inf, np.nan, np.nan
    there = np.stack([np.interp(t[late], s, column) for column in w.T], 1)
    if v.shape[1] != there.shape[1]:
        return np.inf, np.nan, np.nan
    difference = abs(v[late] - there)
    if not np.isfinite(difference).all():
        return np.inf, np.nan, there[-1, 0]
    size = scale or abs(w).max()
    body = difference.max(axis=0).argmax()
    return difference.max() / size, v[late][-1, body], there[-1, body]


def troubles(run, reference, cell):
    """What is wrong with any run, whatever its quantity."""
    found = []
    for group, tables in run.tables.items():
        for table in tables:
            if not np.isfinite(table.rows).all():
                found.append(group + " not finite")
        if "volume" in tables[0].names:
            worst = abs(run.column(group, "volume")[1] - 1).max()
            if not worst < 1e-3:
                found.append("volume of %s %+.2g" % (group, worst))
        if "lengthError" in tables[0].names:
            worst = abs(run.column(group, "lengthError")[1]).max()
            if not worst < 1e-6:
                found.append("length of %s %.2g" % (group, worst))
    ordinary = {group: v.max() for group, _, _, v in reference.speeds()}
    for group, t, dt, v in run.speeds():
        jump = v * dt > 0.25 * cell + 3 * ordinary.get(group, 0) * dt
        if jump.any():
            found.append("%s jumps by %.2g cells at %.4g" % (
                group, (v * dt)[jump][0] / cell, t[jump][0]))
    fast, usual = (max((Co / dt for _, dt, Co in r.steps), default=0) for r in (run, reference))
    if not fast <= 2 * usual + 1e-9:
        found.append("flow %.3g times as fast" % (fast / max(usual, 1e-99)))
    return found


def isClear(run, groups):
    """A stop, or the line before on limits that were exceeded, names the group of the body,
    or without bodies the cell, and says what to do."""
    text = " ".join([run.error, *re.findall(r"deltaT \S+ is above the limit of .*", run.text)])
    places = [r"\b%s\b" % group for group in groups] or ["cell at"]
    remedy = re.search(r"deltaT|[Rr]educe|[Uu]se |start again|smaller|larger|write ", text)
    return bool(remedy and any(re.search(place, text) for place in places))


def judge(name, folder, modes, end: float, cell: float, *health):
    """Rows of the table for the runs in the modes of a case, a line each: name, mode, deltaT,
    its limit, steps, seconds, retries, quantity, value, value of the reference, error,
    verdict, fails (0 or 1), reason. health: triples of quantity, bound, scale (0: the
    largest value). The bound holds at the fixed step and grows in proportion with deltaT,
    up to a quarter, and is at least the error of the step that the log states."""
    reference = Run(folder + "/reference")
    with open(folder + "/fixed.dt") as f:
        fixed = float(f.read())
    bad = [] if reference.ended else [reference.error or "no end"]
    bad = bad or troubles(reference, reference, cell)
    for mode in modes.split():
        run = Run(folder + "/" + mode)
        row = dict(quantity=health[0], value=np.nan, right=np.nan, error=np.nan, why="")
        if run.status in (124, 137, 152):
            row.update(verdict="unfinished", why="at time %g" % (run.steps[-1][0] if run.steps else 0))
        elif not run.ended:
            row["why"] = run.error or " ".join(run.text[-200:].split())
            row["verdict"] = "broken" if not run.error else "stopped" if isClear(run, run.tables or reference.tables) else "unclear"
        elif bad:
            row.update(verdict="noReference", why=bad[0])
        else:
            row.update(compared(run, reference, fixed, cell, health))
        with open(run.folder + "/dt") as f:
            dt = float(f.read())
        limit = promised(run.text)
        promises = mode == "adjusted" or dt <= limit * (1 + 1e-6)
        fails = row["verdict"] not in (("ok",) if promises else ("ok", "stopped", "warned"))
        print("\t".join([name, mode, "%.4g" % dt, "%.4g" % limit, "%d" % run.number, "%.1f" % run.seconds,
                         "%d" % run.retries, row["quantity"],
                         *("%.4g" % row[k] for k in ("value", "right", "error")),
                         row["verdict"], "%d" % fails, row["why"][:400] or "-"]))


def compared(run, reference, fixed, cell, health):
    """The quantity that is furthest beyond its bound, verdict and reason."""
    wrong = troubles(run, reference, cell)
    growth = max(1, run.largestStep() / fixed)
    stated = max([float(x) / 100 for x in re.findall(r"\bstep ([\d.e-]+) %", run.text)], default=0)
    row, excess = {}, -1
    for name, bound, scale in zip(*(health[i::3] for i in range(3))):
        error, value, right = apart(run, reference, name, float(scale))
        allowed = max(min(float(bound) * growth, max(0.25, float(bound))), stated)
        if not error <= allowed:
            wrong.append("%s %.3g apart, bound %.2g" % (name, error, allowed))
        if not error / allowed <= excess:
            excess = error / allowed
            row.update(quantity=name, value=value, right=right, error=error)
    said = [w for w in run.warnings if "deltaT" in w or "further apart" in w]
    row["verdict"] = "ok" if not wrong else "warned" if said else "WRONG"
    row["why"] = "; ".join(wrong + ["said: " + w[-200:] for w in said[:1] if wrong])
    return row


def summary(*files):
    """Numbers of verdicts by mode of tables: a line a mode."""
    rows = [line.rstrip("\n").split("\t") for file in files for line in open(file)]
    for mode in MODES:
        verdicts = [row[11] for row in rows if row[1] == mode]
        counts = ", ".join("%d %s" % (verdicts.count(v), v) for v in sorted(set(verdicts), key=str.lower))
        seconds = sum(float(row[5]) for row in rows if row[1] == mode)
        print("%-9s %s; %.0f s" % (mode, counts or "none", seconds))
