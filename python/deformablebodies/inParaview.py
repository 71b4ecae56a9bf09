"""Opens the bodies and the flow of a case in ParaView, or draws them without a window: see
openInParaview --help. Run by ParaView's own Python, which has paraview.simple.

Membranes are coloured by their larger principal tension, fibres are tubes, rigid bodies plain,
the flow is cut at its middle along z and coloured by its speed. All of them are in the pipeline,
to be changed there.
"""
import glob
import os
import numpy as np
from paraview import simple
from vtkmodules.util.numpy_support import vtk_to_numpy
from deformablebodies import Case, bodies3d


def bodies(case, view, radius):
    """Readers of all groups, shown by what they are."""
    for group in case.groups():
        reader = simple.XMLPolyDataReader(registrationName=group, FileName=[file for _, file in case.pictures(group)])
        reader.UpdatePipeline()
        data = bodies3d.read(case.pictures(group)[-1][1])
        shown = reader
        if data.GetNumberOfPolys():
            shown = simple.GenerateSurfaceNormals(registrationName=group + "Smooth", Input=reader)
            shown.Splitting = 0
        if data.GetNumberOfLines():
            shown = simple.Tube(registrationName=group + "Tubes", Input=reader)
            shown.Scalars, shown.Vectors = [None, ""], [None, ""]
            shown.Radius, shown.NumberofSides = radius or bodies3d.fibreRadius(case, group), 16
        display = simple.Show(shown, view)
        if data.GetPointData().HasArray("tension1"):
            simple.ColorBy(display, ("POINTS", "tension1"))
            table = simple.GetColorTransferFunction("tension1")
            table.ApplyPreset("Viridis (matplotlib)", True)
            display.SetScalarBarVisibility(view, True)
            tension = vtk_to_numpy(data.GetPointData().GetArray("tension1"))
            table.RescaleTransferFunction(0, np.quantile(tension, 0.99))
            table.AutomaticRescaleRangeMode = "Never"
            bar = simple.GetScalarBar(table, view)
            bar.Title, bar.ComponentTitle = "tension1", "[N/m]"
            bar.TitleFontSize = bar.LabelFontSize = 12
            bar.WindowLocation = "Any Location"
            bar.Position, bar.ScalarBarLength = [0.84, 0.3], 0.4
            bar.HorizontalTitle = 1
            bar.LabelFormat = bar.RangeLabelFormat = "%.2g"
            bar.TitleColor = bar.LabelColor = [0, 0, 0]
        else:
            simple.ColorBy(display, ("POINTS", None))
            display.AmbientColor = display.DiffuseColor = [0.36, 0.5, 0.66] if data.GetNumberOfLines() else [0.8, 0.62, 0.4]


def flow(case, view):
    """The flow, cut at its middle along z."""
    if not case.times() or not os.path.isdir(case.path("constant/polyMesh")):
        return
    files = glob.glob(case.path("*.foam")) or [case.path(os.path.basename(case.folder) + ".foam")]
    open(files[0], "a").close()
    reader = simple.OpenFOAMReader(registrationName="flow", FileName=files[0])
    reader.MeshRegions, reader.CellArrays = ["internalMesh"], ["U", "p"]
    reader.UpdatePipeline(float(case.times()[-1]))
    low, high = bodies3d.box(case)
    cut = simple.Slice(registrationName="flowAtItsMiddle", Input=reader)
    cut.SliceType.Origin, cut.SliceType.Normal = list(0.5 * (low + high)), [0, 0, 1]
    display = simple.Show(cut, view)
    display.Opacity = 0.6
    simple.ColorBy(display, ("CELLS", "U", "Magnitude"))
    simple.GetColorTransferFunction("U").ApplyPreset("Cividis (matplotlib)" if "Cividis (matplotlib)" in presets()
                                                     else "Viridis (matplotlib)", True)
    outline = simple.Show(simple.Outline(registrationName="box", Input=reader), view)
    outline.AmbientColor = outline.DiffuseColor = [0.3, 0.3, 0.3]


def presets():
    """Names of the maps of colours that this ParaView has."""
    from paraview import servermanager
    all_ = servermanager.vtkSMTransferFunctionPresets()
    return {all_.GetPresetName(i) for i in range(all_.GetNumberOfPresets())}


def main(folder, radius, picture=None, film=None):
    case = Case(folder)
    simple._DisableFirstRenderCameraReset()
    view = simple.GetActiveViewOrCreate("RenderView")
    view.Background = [1, 1, 1]
    view.UseColorPaletteForBackground = 0
    view.OrientationAxesVisibility = 1
    bodies(case, view, radius)
    flow(case, view)
    simple.GetAnimationScene().UpdateAnimationUsingDataTimeSteps()
    simple.GetAnimationScene().GoToLast()
    view.CameraPosition, view.CameraFocalPoint, view.CameraViewUp = [0.42, 0.32, 1.2], [0, 0, 0], [0, 1, 0]
    simple.ResetCamera(view)
    simple.GetActiveCamera().Zoom(1.3)
    if picture:
        simple.SaveScreenshot(picture, view, ImageResolution=[1300, 1000])
    if film:
        simple.SaveAnimation(film, view, ImageResolution=[1296, 1000], FrameRate=12)


if __name__ == "__main__":
    given = dict(word.split("=", 1) for word in os.environ.get("DEFORMABLE_BODIES_PARAVIEW", "").split("\n") if word)
    main(given.get("case", "."), float(given["radius"]) if "radius" in given else None, given.get("picture"), given.get("film"))
