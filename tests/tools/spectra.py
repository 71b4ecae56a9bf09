"""Spectra of homogeneous turbulence (functionObject energySpectrum)."""
import os
import numpy as np
from deformablebodies import Case


def overReference(folder, reference, most: float, least: float):
    """Mean spectrum E/(dissipation nu^5)^(1/4) of the times with Re_lambda between least and most,
    over that of a file with k eta and E, at nine k eta from 0.1 to 1.2: a line of Markdown, and the
    largest departure from 1 from k eta = 0.2 on."""
    case = Case(folder)
    table = case.table("spectrum", "turbulence.dat")
    nu = table["rms"][-1] * table["taylorLength"][-1] / table["ReLambda"][-1]
    at = lambda name, time: np.interp(time, table["time"], table[name])
    kEta = np.array([0.1, 0.15, 0.2, 0.3, 0.4, 0.6, 0.8, 1, 1.2])
    logs = []
    for file in case.pieces("spectrum", "spectrum.dat"):
        time = float(os.path.basename(os.path.dirname(file)))
        if least <= at("ReLambda", time) <= most:
            k, E = np.loadtxt(file).T
            scale = (at("dissipation", time) * nu**5)**0.25
            logs.append(np.interp(kEta, k * at("kolmogorovLength", time), np.log(E / scale)))
    x, E = np.loadtxt(reference, delimiter=",", skiprows=3).T
    ratio = np.exp(np.mean(logs, axis=0) - np.interp(kEta, x, np.log(E)))
    return "| %d | " % len(logs) + " | ".join("%.2f" % r for r in ratio) + " |\n%.3f" % abs(ratio[kEta >= 0.2] - 1).max()
