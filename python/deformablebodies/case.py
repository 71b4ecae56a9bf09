"""A case of deformableBodyFoam and its results."""
import glob
import json
import os
import re
import numpy as np
from .tables import Table

number = re.compile(r"^[-+]?(\d+\.?\d*|\.\d+)([eE][-+]?\d+)?$")


def field(file):
    """Internal field of a file of OpenFOAM, ascii or binary: n x components, in the order of the
    cells; x first, then y and z in a mesh of one block."""
    with open(file, "rb") as f:
        data = f.read()
    sizes = {b"scalar": 1, b"vector": 3, b"symmTensor": 6, b"tensor": 9}
    binary = re.search(rb"format\s+(\w+);", data)[1] == b"binary"
    head = re.search(rb"internalField\s+nonuniform\s+List<(\w+)>\s*(\d+)\s*\(", data)
    if not head:
        raise ValueError("%s is uniform" % file)
    n, size = int(head[2]), sizes[head[1]]
    if binary:
        return np.frombuffer(data, "<f8", n * size, head.end()).reshape(n, size)
    words = data[head.end():].replace(b"(", b" ").replace(b")", b" ").split(None, n * size)
    return np.array(words[:n * size], float).reshape(n, size)


class Case:
    """The case in a folder. Results of all runs that were restarted are put together.

    folder  of its results
    home    the folder that has its dictionaries: itself, or the nearest one above, where results
            were put aside
    """

    def __init__(self, folder="."):
        self.folder = self.home = os.path.abspath(folder)
        while not os.path.isdir(os.path.join(self.home, "constant")) and self.home != os.path.dirname(self.home):
            self.home = os.path.dirname(self.home)
        if not os.path.isdir(os.path.join(self.home, "constant")):
            self.home = self.folder

    def path(self, *parts):
        return os.path.join(self.folder, *parts)

    def entry(self, name, file="constant/scene"):
        """An entry of a dictionary as it stands there: a number, or its text. None: not there."""
        with open(os.path.join(self.home, file)) as f:
            found = re.search(r"(?:^|[{;])\s*%s\s+([^;{}]*?)\s*;" % re.escape(name), f.read(), re.M)
        if not found:
            return None
        return float(found[1]) if number.match(found[1]) else found[1]

    def pieces(self, function, name):
        """Files of a function in postProcessing, one for each start of the run or, of functionObjects
        that sum up, for each write time, in that order."""
        files = glob.glob(glob.escape(self.path("postProcessing", function)) + "/*/" + name)
        return sorted(files, key=lambda file: float(os.path.basename(os.path.dirname(file))))

    def written(self, function, name):
        """The same. FileNotFoundError: it has none."""
        files = self.pieces(function, name)
        if not files:
            raise FileNotFoundError("%s has no postProcessing/%s/*/%s: it was not run, or has no such output"
                                    % (self.folder, function, name))
        return files

    def table(self, function, name):
        """Table of postProcessing/<function>/<start>/<name>. FileNotFoundError: it has none."""
        return Table.joined(self.written(function, name))

    def latest(self, function, name):
        """The file of the latest time, of a function that sums up the whole run.
        FileNotFoundError: it has none."""
        return self.written(function, name)[-1]

    def bodies(self, group, body=None):
        """Samples of a group, or of one of its bodies. KeyError: there is no such group or body."""
        groups = {os.path.basename(file)[:-4] for file in self.pieces("bodies", "*.dat")}
        if groups and group not in groups:
            raise KeyError("there is no group '%s', but %s" % (group, " ".join(sorted(groups))))
        table = self.table("bodies", group + ".dat")
        if body is None:
            return table
        if body not in table["body"]:
            raise KeyError("there is no body %s of group %s, but %d" % (body, group, len(set(table["body"]))))
        return table.of(body)

    def stress(self):
        return self.table("bulkStress", "bulkStress.dat")

    def averages(self):
        """Means and errors of the bulk stress by name; empty where the run found at its end that the
        transient is not over."""
        if not self.pieces("bulkStress", "averages.dat"):
            return {}
        table = Table(self.latest("bulkStress", "averages.dat"))
        if not len(table):
            return {}
        # Averages are written with the fields, at the last sample before these
        written = self.times(ranks=True)
        samples = self.stress()["time"]
        if written and float(written[-1]) > 0:
            samples = samples[samples < 1.000001 * float(written[-1])]
        ended = not len(samples) or table["time"][-1] >= 0.999 * samples[-1]
        return table.last() if ended else {}

    def means(self, function, group):
        """Mean, error (-1: not known) and deviation of each quantity, by bodyStatistics."""
        with open(self.latest(function, group + ".means.dat")) as f:
            rows = (line.split() for line in f if not line.startswith("#"))
            return {row[0]: tuple(map(float, row[1:])) for row in rows}

    def groups(self):
        """Groups of bodies that have pictures."""
        series = glob.glob(glob.escape(self.path("postProcessing/VTK/bodies")) + "/*.vtp.series")
        return sorted(os.path.basename(file)[:-len(".vtp.series")] for file in series)

    def pictures(self, group):
        """(time, file .vtp) of each picture of a group."""
        with open(self.path("postProcessing/VTK/bodies", group + ".vtp.series")) as f:
            files = json.load(f)["files"]
        return [(file["time"], self.path("postProcessing/VTK/bodies", file["name"])) for file in files]

    def shapes(self, group):
        """(time, points n x 3) of each picture of a group."""
        from .bodies3d import points
        return [(time, points(file)) for time, file in self.pictures(group)]

    def times(self, ranks=False):
        """Times whose fields were written, in their order. ranks: also those that ranks have."""
        folders = [self.folder] + (glob.glob(self.path("processor*"))[:1] if ranks else [])
        names = {name for folder in folders for name in os.listdir(folder) if number.match(name)}
        return sorted(names, key=float)

    def field(self, name, time=None):
        """Values of a field in the cells (see field), by default at the last time, else at a time or
        the name of its folder."""
        times = self.times()
        found = [t for t in times if time is None or t == str(time) or float(t) == float(time)]
        if not found:
            raise FileNotFoundError("%s has no fields%s, but of times %s" % (
                self.folder, "" if time is None else " of time %s" % time, " ".join(times)))
        return field(self.path(found[-1], name))
