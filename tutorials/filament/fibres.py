"""What the plots of these scenes read, in the case directory: the samples of a group
and the shapes that were drawn."""
import glob
import json

import numpy as np


def samples(group, body=0):
    """Columns of postProcessing/bodies/*/<group>.dat by name; restarts leave one
    file each."""
    files = sorted(glob.glob(f"postProcessing/bodies/*/{group}.dat"),
                   key=lambda f: float(f.split("/")[-2]))
    rows = np.vstack([np.loadtxt(f, ndmin=2) for f in files])
    names = open(files[0]).readline().split()[1:]
    rows = rows[rows[:, names.index("body")] == body]
    return {n: rows[:, i] for i, n in enumerate(names)}


def scene(entry):
    """A number of constant/scene."""
    for line in open("constant/scene"):
        if line.split(" ")[0] == entry:
            return float(line.split()[1].strip(";"))
    raise KeyError(entry)


def shapes(group):
    """(time, nodes) of the only filament of a group, one per picture."""
    import vtk
    from vtk.util.numpy_support import vtk_to_numpy
    all_ = []
    for entry in json.load(open(f"postProcessing/VTK/bodies/{group}.vtp.series"))["files"]:
        reader = vtk.vtkXMLPolyDataReader()
        reader.SetFileName("postProcessing/VTK/bodies/" + entry["name"])
        reader.Update()
        x = vtk_to_numpy(reader.GetOutput().GetPoints().GetData())
        all_.append((entry["time"], x))
    return all_
