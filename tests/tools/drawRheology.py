"""Figure of the study of suspensions: drawRheology.py table.csv picture.png

A row of panels for each Reynolds number of capsules and of fibres; a column for each quantity. Points of
the second kind (a wide box, no lubrication) are left out, and kinds of one point."""
import re
import sys
from deformablebodies import figures
from deformablebodies.tables import records

quantities = (("viscosity", "error", "relative viscosity"), ("N1", "N1error", r"$N_1/(\mu\dot\gamma)$"),
              ("N2", "N2error", r"$N_2/(\mu\dot\gamma)$"), ("D", None, "mean D"))


def number(pattern, row):
    return float(re.search(pattern, row["point"])[1])


def lines(rows, key, x):
    """Rows of each key, in the order of x."""
    for value in sorted({key(r) for r in rows}):
        yield value, sorted((r for r in rows if key(r) == value), key=x)


def draw(panels, rows, key, x, look):
    """A line for each key in each panel."""
    for value, line in lines(rows, key, x):
        for panel, (y, error, _) in zip(panels, quantities):
            bars = [max(float(r[error]), 0) for r in line] if error else None
            panel.errorbar([x(r) for r in line], [float(r[y]) for r in line], bars,
                           **look(value))


rows = [r for r in records(sys.argv[1]) if not re.search(r"\.[a-zA-Z]+$", r["point"])]
kinds = [(kind, Re, [r for r in rows if r["point"].startswith("%s.Re%s." % (kind, Re))])
         for kind in ("capsules", "fibres") for Re in ("0.1", "1", "10")]
kinds = [k for k in kinds if len(k[2]) > 1]
figure, axes = figures.plt.subplots(len(kinds), 4, figsize=(14, 3.4 * len(kinds) + 0.4), squeeze=False)
for panels, (kind, Re, some) in zip(axes, kinds):
    if kind == "capsules":
        Ca = lambda r: number(r"Ca(\d+\.\d)", r)
        colour = figures.shades(sorted({Ca(r) for r in some}))
        draw(panels, some, lambda r: (Ca(r), "rigid" in r["point"]), lambda r: float(r["fraction"]),
             lambda v: {"color": colour[v[0]], "fmt": "s--" if v[1] else "o-",
                        "label": "Ca %g" % v[0] + (", rigid nuclei" if v[1] else "")})
    else:
        colour = figures.shades(sorted({float(r["fraction"]) for r in some}))
        draw(panels, some, lambda r: float(r["fraction"]), lambda r: number(r"B(.*)$", r),
             lambda v: {"color": colour[v], "fmt": "o-", "label": r"$nL^3$ = %g" % v})
    for panel, (_, _, text) in zip(panels, quantities):
        panel.set(xlabel="volume fraction" if kind == "capsules" else r"$B/(\mu\dot\gamma L^4)$",
                  ylabel="end to end" if kind == "fibres" and text == "mean D" else text)
        if kind == "fibres":
            panel.set_xscale("log")
    panels[0].set_title("%s, Re %s" % (kind, Re), loc="left")
    panels[0].legend(fontsize=7)
figures.save(figure, sys.argv[2])
