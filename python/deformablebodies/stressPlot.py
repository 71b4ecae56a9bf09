"""Bulk stress of a case over time, and who carries it.

    stressPlot [-h] [case] [picture.png] [--reference lower[,upper]] [--text label]

Reads postProcessing/bulkStress of all runs of the case (default: this folder) and prints the
means with their errors, from averages.dat.
"""
import argparse
import sys
import numpy as np
from . import figures
from .case import Case

# Columns of bulkStress.dat that are no parts of the stress of the bodies
totals = ["time", "relativeViscosity", "N1", "N2", "particleStress", "reynoldsStress", "wallStress",
          "unsteady", "residual", "wallLower", "wallUpper", "contactPressure"]


def main():
    parser = argparse.ArgumentParser(prog="stressPlot", description=__doc__.split("\n")[0])
    parser.add_argument("case", nargs="?", default=".")
    parser.add_argument("picture", nargs="?", default="stress.png")
    parser.add_argument("--reference", help="relative viscosity, or its range: lower,upper")
    parser.add_argument("--text", default="reference", help="name of the reference")
    options = parser.parse_args()
    case = Case(options.case)
    try:
        stress = case.stress()
    except FileNotFoundError as e:
        sys.exit("stressPlot: %s" % e)
    mean = case.averages()
    parts = [name for name in stress.names if name not in totals]

    figure, (left, middle, right) = figures.columns(3)
    left.plot(stress["time"], stress["relativeViscosity"], label="1 + bodies + Reynolds")
    left.plot(stress["time"], stress["wallStress"], lw=1, color="0.6", label="sides")
    if options.reference:
        values = [float(x) for x in options.reference.split(",")]
        if len(values) > 1:
            left.axhspan(*values, color=figures.orange, alpha=0.2, lw=0, label=options.text)
        else:
            left.axhline(values[0], **figures.theory, label=options.text)
    if mean:
        value, error = mean["relativeViscosity"], mean["relativeViscosityError"]
        left.hlines(value, mean["from"], mean["time"], figures.blue, ls="--",
                    label=f"mean {value:.4g}" + (rf" $\pm$ {error:.2g}" if error >= 0 else ""))
    left.set(title=r"relative viscosity")
    for name in parts + ["reynoldsStress"]:
        if np.abs(stress[name]).max() > 1e-3 * np.abs(stress["particleStress"]).max():
            middle.plot(stress["time"], stress[name], label=name)
    middle.set(title=r"parts of the shear stress/$\mu \dot\gamma$")
    for name, label in (("N1", "$N_1$"), ("N2", "$N_2$")):
        right.plot(stress["time"], stress[name], label=label)
    right.set(title=r"normal stress differences/$\mu \dot\gamma$")
    for axes in (left, middle, right):
        axes.set(xlabel="t [s]", xlim=(0, stress["time"][-1]))
        axes.legend()
    figures.save(figure, options.picture)
    if not mean:
        print("No means yet: the transient is not over (startAverage sets its end)")
        return
    for name in ("relativeViscosity", "N1", "N2", "particleStress", "reynoldsStress", "wallStress", *parts):
        error = mean[name + "Error"]
        print(f"{name:18} {mean[name]:10.4f}" + (f" +- {error:.4f}" if error >= 0 else ""))


if __name__ == "__main__":
    main()
