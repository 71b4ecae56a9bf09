"""Figures of the study of suspensions: drawRheology.py table.csv folder

rheology-capsules.png: over the volume fraction at the smallest and the largest Reynolds number, and over
this number at 30 %. rheology-fibres.png: over the stiffness. Points of two values are not joined."""
import os
import re
import sys
from deformablebodies import Case, figures
from deformablebodies.tables import records

tutorials = os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../tutorials/")
stresses = (("viscosity", "error", "relative viscosity"), ("N1", "N1error", r"$N_1/(\mu\dot\gamma)$"),
            ("N2", "N2error", r"$N_2/(\mu\dot\gamma)$"))


def points(pattern, names):
    """Rows whose name matches, with the parts of the name as further columns."""
    found = ((re.fullmatch(pattern, r["point"]), r) for r in records(sys.argv[1]))
    return [{**r, **dict(zip(names, m.groups()))} for m, r in found if m]


def draw(panels, quantities, rows, x, colour, mark, label, line="-"):
    """These points in a panel of each quantity."""
    rows = sorted(rows, key=lambda r: float(r[x]))
    for panel, (y, error, _) in zip(panels, quantities) if rows else ():
        panel.errorbar([float(r[x]) for r in rows], [float(r[y]) for r in rows],
                       [max(float(r[error] or 0), 0) for r in rows], fmt=mark, color=colour,
                       ls=line if len(rows) > 2 else "none", mfc="white" if mark == "s" else colour, label=label)


def drawCapsules(picture):
    rows = points(r"capsules\.Re([\d.]+)\.(none|rigid)\.Ca([\d.]+?)\.0\.\d+(\.wide)?", ("Re", "nucleus", "Ca", "wide"))
    if not rows:
        return
    quantities = (*stresses, ("D", "Derror", "mean $D$"))
    Re = sorted({r["Re"] for r in rows}, key=float)
    figure, axes = figures.columns(3, 2.2, 3.3, 4, sharex="col", sharey="row")
    for nucleus, mark, line, text in (("none", "o", "-", ""), ("rigid", "s", "--", ", rigid nuclei")):
        for Ca, colour in figures.shades(sorted({r["Ca"] for r in rows}, key=float)).items():
            some = [r for r in rows if (r["Ca"], r["nucleus"], r["wide"]) == (Ca, nucleus, None)]
            look = (colour, mark, f"$Ca_G$ = {Ca}{text}", line)
            for column, value in ((0, Re[0]), (1, Re[-1])):
                draw(axes[:, column], quantities, [r for r in some if r["Re"] == value], "fraction", *look)
            draw(axes[:, 2], quantities, [r for r in some if r["fraction"] == "0.3"], "Re", *look)
    draw(axes[:, 0], quantities, [r for r in rows if r["wide"] and r["Re"] == Re[0]], "fraction", figures.purple, "D",
         "wider box, $Ca_G$ = 0.3")
    spheres = records(tutorials + "rigid/sphereSuspension/reference.csv")
    formulas = [[float(v) for k, v in r.items() if k != "phi"] for r in spheres]
    axes[0][0].fill_between([float(r["phi"]) for r in spheres], [min(f) for f in formulas], [max(f) for f in formulas],
                            color=figures.orange, alpha=0.2, lw=0, label="rigid spheres, formulas")
    axes[0][0].plot([0, 0.42], [1, 1 + 2.5 * 0.42], **figures.theory, label="rigid spheres, dilute (Einstein)")
    if Re[-1] == "10":
        other = records(tutorials + "capsule/suspensionShear/reference.csv")
        axes[0][1].plot([float(r["phi"]) for r in other], [float(r["viscosity"]) for r in other],
                        **{**figures.reference, "marker": "x", "zorder": 5}, label="published, $Ca_G$ = 0.3")
    for panel, title in zip(axes[0], (f"Re = {Re[0]}", f"Re = {Re[-1]}", "volume fraction 0.3")):
        panel.set_title(title)
    for row, (_, _, text) in zip(axes, quantities):
        row[0].set_ylabel(text)
    for panel in axes[1:3].flat:
        panel.axhline(0, color="0.6", lw=0.8)
    for panel, text in zip(axes[-1], ("volume fraction", "volume fraction", "Re")):
        panel.set_xlabel(text)
    for panel in axes[0][:2]:
        panel.set(xlim=(0.03, 0.42), ylim=(1, 3.2))
    axes[0][2].set_xscale("log")
    figures.plainTicks(axes[0][2].xaxis)
    figures.legendAbove(figure, axes.flat, 3)
    figures.save(figure, picture, dpi=95)


def drawFibres(picture):
    rows = points(r"fibres\.Re([\d.]+)\.(\d+)\.B([\d.]+?)(\.noLubrication)?", ("Re", "nL3", "B", "dry"))
    if not rows:
        return
    L = Case(tutorials + "filament/suspensionShear").entry("L")
    for r in rows:
        r["length"], r["lengthError"] = float(r["D"]) / L, float(r["Derror"] or 0) / L
    quantities = (*stresses, ("length", "lengthError", "distance of the ends/$L$"))
    figure, axes = figures.columns(2, 2.9, 4.4, 2, sharex=True)
    # Side by side: a factor of the stiffness for each Reynolds number
    for Re, mark, line, beside in (("10", "o", "-", 1), ("1", "s", "--", 1.15), ("0.1", "^", ":", 0.87)):
        for nL3, colour in (("3", figures.blue), ("10", figures.black), ("30", figures.green)):
            for dry in (None, ".noLubrication"):
                own = [r for r in rows if (r["Re"], r["nL3"], r["dry"]) == (Re, nL3, dry)]
                for r in own:
                    r["B"] = float(r["B"]) * beside**(2 if dry else 1)
                draw(axes.flat, quantities, own, "B", figures.orange if dry else colour, "x" if dry else mark,
                     f"$nL^3$ = {nL3}, Re = {Re}" + (", no lubrication" if dry else ""), line)
    for panel, (_, _, text) in zip(axes.flat, quantities):
        panel.set(xscale="log", ylabel=text)
    for panel in axes.flat[1:3]:
        panel.axhline(0, color="0.6", lw=0.8)
    axes.flat[3].axhline(1, color="0.6", lw=0.8)
    for panel in axes[-1]:
        panel.set_xlabel(r"$B/(\mu\dot\gamma L^4)$")
    figures.legendAbove(figure, axes.flat, 3)
    figures.save(figure, picture, dpi=110)


drawCapsules(sys.argv[2] + "/rheology-capsules.png")
drawFibres(sys.argv[2] + "/rheology-fibres.png")
