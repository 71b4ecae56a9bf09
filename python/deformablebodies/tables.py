"""Files of columns: a first line of names that begins with #, then rows of numbers."""
import csv
import numpy as np


class Table:
    """Columns by name, rows in the order of the file.

    names   of the columns
    units   by name; empty where the file has none
    rows    array, a row for each line
    """

    def __init__(self, file=None, names=(), rows=None, units=None):
        self.names, self.units = list(names), units or {}
        self.rows = np.zeros((0, len(self.names))) if rows is None else rows
        if file is None:
            return
        # Read once: the file may be a pipe
        with open(file) as f:
            lines = f.readlines()
        heads = [line.split()[1:] for line in lines[:2] if line.startswith("#")]
        if heads:
            self.names = heads[0]
        if len(heads) > 1:
            # Columns beyond those that are named have the unit of the last
            units = [unit.strip("[]") for unit in heads[1]]
            units += units[-1:] * (len(self.names) - len(units))
            self.units = dict(zip(self.names, units))
        numbers = [line for line in lines if not line.startswith("#") and line.strip()]
        self.rows = np.loadtxt(numbers, ndmin=2) if numbers else np.zeros((0, len(self.names)))

    @classmethod
    def joined(cls, files):
        """One table of the pieces of a run: rows of later pieces replace those from their
        first time on. Columns that a piece lacks are left out."""
        tables = [table for table in map(cls, files) if len(table)]
        if not tables:
            return cls(files[0])
        names = [name for name in tables[0].names if all(name in table.names for table in tables)]
        columns = lambda table: table.rows[:, [table.names.index(name) for name in names]]
        rows = columns(tables[0])
        for table in tables[1:]:
            rows = np.vstack([rows[rows[:, 0] < table.rows[0, 0]], columns(table)])
        return cls(names=names, rows=rows, units={k: v for k, v in tables[0].units.items() if k in names})

    def __getitem__(self, name):
        if name not in self.names:
            raise KeyError("there is no column '%s', but %s" % (name, " ".join(self.names)))
        return self.rows[:, self.names.index(name)]

    def __contains__(self, name):
        return name in self.names

    def __len__(self):
        return len(self.rows)

    def where(self, rows):
        """The table of some rows: a mask, or their numbers."""
        return Table(names=self.names, rows=self.rows[rows], units=self.units)

    def after(self, time):
        """Rows later than a time."""
        return self.where(self.rows[:, 0] > time)

    def of(self, body):
        """Rows of a body, by its number."""
        return self.where(self["body"] == body)

    def last(self):
        """The last row by name."""
        return dict(zip(self.names, self.rows[-1]))

    def frame(self):
        """As a DataFrame of pandas."""
        import pandas
        return pandas.DataFrame(self.rows, columns=self.names)


def timeWeights(times):
    """Weight of each row in a mean over time, the time since the rows before: of means where steps vary.
    Rows of one time (several bodies) share it."""
    once, of = np.unique(times, return_inverse=True)
    since = np.diff(once, prepend=2 * once[0] - once[min(1, len(once) - 1)])
    return (since / np.bincount(of))[of] if len(once) > 1 else np.ones(len(times))


def meanAndError(values, weights):
    """Mean of a series and its standard error: the largest of those by 8, 16, 32 and 64 blocks of equal
    weight, as blocks that are too short follow each other."""
    ends = np.cumsum(weights)
    errors = []
    for n in (8, 16, 32, 64):
        of = np.minimum((n * (ends - 0.5 * weights) / ends[-1]).astype(int), n - 1)
        sums, weight = (np.bincount(of, x, n) for x in (values * weights, weights))
        if weight.all():
            errors.append((sums / weight).std(ddof=1) / np.sqrt(n))
    return (values * weights).sum() / ends[-1], max(errors, default=-1)


def records(file):
    """Rows of a .csv file as dictionaries of words by column; lines that begin with # are left out."""
    with open(file) as f:
        return list(csv.DictReader(line for line in f if not line.startswith("#")))
