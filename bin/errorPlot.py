"""Errors against core seconds, as accuracyCost draws them: a line for each setting."""
from matplotlib import ticker


def drawErrors(axis, rows, baseSeconds, unit, fontsize, label="{setting}"):
    """rows of accuracyCost.csv (setting, value, result, error, seconds, how its limit was found),
    in order; errors times unit. The finest value is hollow: its error is the uncertainty of the
    limit. Later drawings must not set the scales again, as this would remove the ticks."""
    least = 1e-8 * unit
    for setting in dict.fromkeys(r[0] for r in rows):
        own = [r for r in rows if r[0] == setting]
        drawn = [r for r in own if float(r[3]) > 0]
        x, y = [float(r[4]) for r in drawn], [max(unit * float(r[3]), least) for r in drawn]
        line, = axis.loglog(x, y, "o-", label=label.format(setting=setting, how=own[-1][5]))
        if drawn and drawn[-1] is own[-1] and not own[-1][5].startswith("taken"):
            axis.plot(x[-1:], y[-1:], "o", color=line.get_color(), mfc="white")
        for r, a, b in zip(drawn, x, y):
            axis.annotate(r[1], (a, b), textcoords="offset points", xytext=(4, 4), fontsize=fontsize)
    axis.axvline(baseSeconds, color="0.7", lw=1, zorder=0)
    for part in (axis.xaxis, axis.yaxis):
        part.set_major_locator(ticker.LogLocator(subs=(1, 2, 5)))
        part.set_major_formatter("{x:g}")
        part.set_minor_formatter(ticker.NullFormatter())
    axis.grid(alpha=0.3)
