"""One look of all plots.

    from deformablebodies import figures
    figure, (left, right) = figures.columns(2)
    left.plot(t, D, label="deformableBodyFoam")
    left.plot(*reference, **figures.reference, label="Author 1999")
    figures.save(figure, "results/deformation.png")     # and deformation.pdf

Colours are told apart by readers who are colour-blind (Okabe & Ito 2008); maps of ordered
values are viridis, of signed ones `signed`.
"""
import os
import matplotlib
matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from matplotlib import ticker
from matplotlib.container import ErrorbarContainer

black, blue, orange, green, purple, yellow = "k", "#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00"
signed = "PuOr"

# Published values, and lines that theory draws
reference = {"ls": "none", "marker": "s", "ms": 4.5, "mfc": "none", "color": orange}
theory = {"ls": "--", "lw": 1.2, "color": orange}

plt.rcParams.update({
    "font.family": "DejaVu Sans", "mathtext.fontset": "dejavusans", "font.size": 9, "axes.titlesize": 9,
    "legend.fontsize": 8, "legend.frameon": False, "axes.grid": True, "grid.alpha": 0.25, "grid.linewidth": 0.6,
    "axes.linewidth": 0.7, "lines.linewidth": 1.4, "lines.markersize": 4, "errorbar.capsize": 2.5,
    "axes.prop_cycle": plt.cycler(color=[black, blue, orange, green, purple, yellow]), "image.cmap": "viridis",
    "savefig.dpi": 130, "figure.constrained_layout.use": True, "pdf.fonttype": 42})


def columns(n=1, height=3.3, width=3.9, rows=1, widths=None, **options):
    """A figure with n axes side by side, in one row or more, each of a width and height [inches]; widths:
    their ratios."""
    return plt.subplots(rows, n, figsize=(n * width + (0.8 if n == 1 else 0), rows * height),
                        gridspec_kw={"width_ratios": widths}, **options)


def shades(values):
    """A colour of viridis for each of some ordered values."""
    values = list(values)
    return dict(zip(values, plt.cm.viridis(np.linspace(0, 0.88, len(values)))))


def legendAbove(figure, axes, columns):
    """One legend of all these axes above the panels, each label once, points with errors first."""
    entries = {}
    for axis in axes:
        for handle, label in sorted(zip(*axis.get_legend_handles_labels()),
                                    key=lambda entry: not isinstance(entry[0], ErrorbarContainer)):
            entries.setdefault(label, handle)
    # The layout keeps room for the title
    figure.suptitle("\n" * -(-len(entries) // columns), fontsize=9)
    figure.legend(entries.values(), entries.keys(), loc="upper center", ncol=columns)


def plusMinus(error, form=".2g"):
    """An error for a label; nothing where it is not known, negative."""
    return rf" $\pm$ {error:{form}}" if error >= 0 else ""


def save(figure, picture, **options):
    """Write a picture (options of savefig), and the same as .pdf beside a .png."""
    os.makedirs(os.path.dirname(os.path.abspath(picture)), exist_ok=True)
    figure.savefig(picture, **options)
    if picture.endswith(".png"):
        figure.savefig(picture[:-4] + ".pdf")


def plainTicks(side):
    """Numbers 1, 2, 5, 10 ... at a logarithmic side (axes.xaxis, axes.yaxis); another is left as it is."""
    if side.get_scale() == "log":
        side.set_major_locator(ticker.LogLocator(subs=(1, 2, 5)))
        side.set_major_formatter("{x:g}")
        side.set_minor_formatter(ticker.NullFormatter())


def front(cost, error):
    """Mask of the points that no cheaper one reaches in error: the Pareto front."""
    cost, error = np.asarray(cost), np.asarray(error)
    dominated = [((cost <= c) & (error <= e) & ((cost < c) | (error < e))).any() for c, e in zip(cost, error)]
    return ~np.array(dominated, dtype=bool)


def errorsAgainstSeconds(axis, rows, baseSeconds, unit, fontsize, label="{setting}"):
    """rows of accuracyCost.csv (setting, value, result, error, seconds, how its limit was found),
    errors times unit: a line through the Pareto front of each setting. The finest value is
    hollow: its error is the uncertainty of the limit. Later drawings must not set the scales
    again, as this would remove the ticks."""
    least = 1e-8 * unit
    for setting in dict.fromkeys(r[0] for r in rows):
        own = [r for r in rows if r[0] == setting]
        finest = own[-1]
        drawn = sorted((r for r in own if float(r[3]) > 0), key=lambda r: float(r[4]))
        x, y = np.array([float(r[4]) for r in drawn]), np.array([max(unit * float(r[3]), least) for r in drawn])
        marks, = axis.loglog(x, y, "o", label=label.format(setting=setting, how=finest[5]))
        best = front(x, y)
        axis.plot(x[best], y[best], color=marks.get_color())
        if finest in drawn and not finest[5].startswith("taken"):
            k = drawn.index(finest)
            axis.plot(x[k], y[k], "o", color=marks.get_color(), mfc="white")
        names = []
        for r, a, b in zip(drawn, x, y):
            # Points that lie close together share a text
            if names and a < 1.3 * names[-1][0] and 0.7 < b / names[-1][1] < 1.4:
                names[-1][2] += ", " + r[1]
            else:
                names.append([a, b, r[1]])
        for a, b, text in names:
            axis.annotate(text, (a, b), textcoords="offset points", xytext=(4, 4), fontsize=fontsize)
    axis.axvline(baseSeconds, color="0.7", lw=1, zorder=0)
    plainTicks(axis.xaxis)
    plainTicks(axis.yaxis)
