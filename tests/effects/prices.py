"""prices.py effects.csv folder: effects.csv and effects.md in it, from the counts of prices"""
import csv
import shutil
import sys

rows = list(csv.DictReader(open(sys.argv[1])))
head = """# What each effect costs

Made by `tests/effects/prices`. An effect that a scene does not ask for costs nothing: with its entry at the off-value
(ratio 1, modulus 0, `off`) a step calls the same functions, takes as many instructions within 0.1 %, asks for no more
memory and gives the same digits as without the entry (`tests/effects/run -count`).

The unit is a time step: instructions (counted by callgrind in a build without vector instructions) and microseconds
(this build, the least of five runs on one core of a busy machine: a twentieth of a step is in the noise). "More" is
against the scene without the effect, named behind it. For a case of your own: `bin/effectPrice <case>`.
"""


def share(x):
    return "%+.1f %%" % (100 * x)


out = [head]
for title in dict.fromkeys(r["scene"] for r in rows):
    own = {r["effect"]: r for r in rows if r["scene"] == title}
    bodies, cells = (int(next(iter(own.values()))[k]) for k in ("bodies", "cells"))
    out.append("\n## %s, %d cells\n" % (title, cells))
    out.append("| effect | instructions [1e6] | more | microseconds | more | more instructions per body | per cell |")
    out.append("|---|---|---|---|---|---|---|")
    for name, r in own.items():
        n, t = float(r["instructions"]), float(r["microseconds"])
        if not r["against"]:
            out.append("| %s | %.2f | | %.0f | | | %.0f |" % (name, n / 1e6, t, n / cells))
            continue
        other = own[r["against"]]
        dn, dt = n - float(other["instructions"]), t - float(other["microseconds"])
        out.append("| %s, more than %s | %.2f | %s | %.0f | %s | %.0f | %.1f |" % (
            name, r["against"], n / 1e6, share(dn / float(other["instructions"])), t,
            share(dt / float(other["microseconds"])), dn / bodies, dn / cells))
open(sys.argv[2] + "/effects.md", "w").write("\n".join(out) + "\n")
shutil.copy(sys.argv[1], sys.argv[2] + "/effects.csv")
