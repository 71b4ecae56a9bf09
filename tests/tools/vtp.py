"""Pictures of bodies: files .vtp and their series."""
import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkFiltersCore import vtkCleanPolyData, vtkPolyDataConnectivityFilter, vtkTriangleFilter
from deformablebodies import Case
from deformablebodies.bodies3d import points, pointsOf, read


def array(data, name):
    """Values at points."""
    return vtk_to_numpy(data.GetPointData().GetArray(name))


def lines(file):
    """Coordinates of each line, first to last point."""
    data = read(file)
    x = pointsOf(data)
    cells = (data.GetCell(i) for i in range(data.GetNumberOfCells()))
    return [x[[cell.GetPointId(k) for k in range(cell.GetNumberOfPoints())]] for cell in cells]


def triangles(data):
    """Surfaces of triangles only."""
    filter = vtkTriangleFilter()
    filter.SetInputData(data)
    filter.Update()
    return filter.GetOutput()


def bodies(file):
    """Connected surfaces, of triangles, each with its own points only."""
    data = triangles(read(file))
    parts = vtkPolyDataConnectivityFilter()
    parts.SetInputData(data)
    parts.SetExtractionModeToAllRegions()
    parts.Update()
    number = parts.GetNumberOfExtractedRegions()
    parts.SetExtractionModeToSpecifiedRegions()
    found = []
    for region in range(number):
        parts.InitializeSpecifiedRegionList()
        parts.AddSpecifiedRegion(region)
        clean = vtkCleanPolyData()
        clean.SetInputConnection(parts.GetOutputPort())
        clean.Update()
        body = vtkPolyData()
        body.DeepCopy(clean.GetOutput())
        found.append(body)
    return found


def counts(file):
    """Numbers of points, cells and pieces, and the largest |coordinate| of the middles of
    bodies."""
    data = read(file)
    x, body = pointsOf(data), array(data, "body")
    middles = [x[body == b].mean(0) for b in range(int(body.max()) + 1)]
    with open(file, "rb") as f:
        pieces = f.read().count(b"<Piece")
    return data.GetNumberOfPoints(), data.GetNumberOfCells(), pieces, "%.3f" % max(abs(m).max() for m in middles)


def lowest(group):
    """Least y of the last picture of a group."""
    return points(Case().pictures(group)[-1][1])[:, 1].min()


def tensionNoise(group, resolution: float):
    """Later half of a group's pictures: largest tension, and the largest departure
    (root mean square) from its mean within a cell, over that tension. resolution: cells
    per unit of length."""
    highest, noise = [], []
    all = Case().pictures(group)
    for _, file in all[len(all) // 2:]:
        data = read(file)
        x, T = pointsOf(data), array(data, "tension1")
        near = ((x[:, None] - x)**2).sum(-1) < 1 / resolution**2
        highest.append(T.max())
        noise.append(np.sqrt(np.mean((T - near @ T / near.sum(1))**2)) / T.max())
    return "%.4g" % max(highest), "%.3f" % max(noise)


def loads(file, name, samples, columns):
    """Field of a picture, times the areas where it is per area, summed up over each body, less
    columns (of x) of the last samples: largest difference over the largest sum."""
    from deformablebodies import Table
    data = read(file)
    field, body = array(data, name).astype(float), array(data, "body")
    if name in ("load", "traction"):
        field = field * array(data, "area").astype(float)[:, None]
    table = Table(samples)
    at = table.names.index(columns)
    last = table.rows[table["time"] == table["time"][-1]]
    worst = largest = 0
    for row in last:
        total = field[body == row[1]].sum(0)
        worst = max(worst, abs(total - row[at:at + 3]).max())
        largest = max(largest, abs(total).max())
    return "%.2e" % (worst / largest)
