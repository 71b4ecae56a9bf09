"""Bulk stress of a case over time, and who carries it.

    stressPlot [-h] [case] [picture.png] [--reference lower[,upper]] [--text label]

Reads postProcessing/bulkStress of all runs of the case (default: this folder) and prints the
means with their errors, from averages.dat.
"""
import argparse
import glob
import os
import sys

import matplotlib
matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

parser = argparse.ArgumentParser(prog="stressPlot", description=__doc__.split("\n")[0])
parser.add_argument("case", nargs="?", default=".")
parser.add_argument("picture", nargs="?", default="stress.png")
parser.add_argument("--reference", help="relative viscosity, or its range: lower,upper")
parser.add_argument("--text", default="reference", help="name of the reference")
options = parser.parse_args()


def table(name):
    """Rows of all runs of the case, later runs in place of earlier ones, and their columns."""
    files = sorted(glob.glob(f"{options.case}/postProcessing/bulkStress/*/{name}"),
                   key=lambda f: float(f.split("/")[-2]))
    if not files:
        return None, []
    columns = open(files[0]).readline().split()[1:]
    rows = np.zeros((0, len(columns)))
    for file in files:
        new = np.loadtxt(file, ndmin=2)
        rows = np.vstack([rows[rows[:, 0] < new[0, 0]] if len(new) else rows, new])
    return rows, columns


rows, columns = table("bulkStress.dat")
if rows is None:
    sys.exit(f"stressPlot: {os.path.abspath(options.case)} has no postProcessing/bulkStress")
at = {name: rows[:, i] for i, name in enumerate(columns)}
fixed = ["time", "relativeViscosity", "N1", "N2", "particleStress", "reynoldsStress", "wallStress",
         "unsteady", "residual", "wallLower", "wallUpper", "contactPressure"]
parts = [name for name in columns if name not in fixed]
averages, names = table("averages.dat")
mean = dict(zip(names, averages[-1])) if averages is not None else {}

figure, (left, middle, right) = plt.subplots(1, 3, figsize=(13, 4))
left.plot(at["time"], at["relativeViscosity"], label="1 + bodies + Reynolds")
left.plot(at["time"], at["wallStress"], lw=1, color="0.6", label="sides")
if options.reference:
    values = [float(x) for x in options.reference.split(",")]
    left.axhspan(values[0], values[-1], color="tab:green", alpha=0.2, label=options.text) \
        if len(values) > 1 else left.axhline(values[0], color="tab:green", label=options.text)
if mean:
    value, error = mean["relativeViscosity"], mean["relativeViscosityError"]
    left.hlines(value, mean["from"], mean["time"], "k", ls="--",
                label=f"mean {value:.4g}" + (f" +- {error:.2g}" if error >= 0 else ""))
left.set(title="relative viscosity", xlabel="time [s]")
for name in parts + ["reynoldsStress"]:
    if np.abs(at[name]).max() > 1e-3*np.abs(at["particleStress"]).max():
        middle.plot(at["time"], at[name], label=name)
middle.set(title="parts of the shear stress/(mu rate)", xlabel="time [s]")
for name in ("N1", "N2"):
    right.plot(at["time"], at[name], label=name)
right.set(title="normal stress differences/(mu rate)", xlabel="time [s]")
for axes in (left, middle, right):
    axes.legend(fontsize=8)
    axes.grid(alpha=0.3)
figure.tight_layout()
figure.savefig(options.picture, dpi=110)
if not mean:
    print("No means yet: the transient is not over (startAverage sets its end)")
for name in ("relativeViscosity", "N1", "N2", "particleStress", "reynoldsStress", "wallStress", *parts):
    if mean:
        error = mean[name + "Error"]
        print(f"{name:18} {mean[name]:10.4f}" + (f" +- {error:.4f}" if error >= 0 else ""))
