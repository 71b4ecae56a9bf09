"""Pictures of bodies by VTK: surfaces smooth, membranes by their larger principal tension over
Gs, fibres as tubes, in the outline of the box. See drawBodies --help.

    from deformablebodies import Case, bodies3d
    view = bodies3d.View(Case("."))
    view.add("cells")
    view.write("suspension.png")
"""
import os
import re
import subprocess
import sys
import numpy as np


def onDisplay():
    """VTK draws on a display: without one, this program once more on a virtual one."""
    if not os.environ.get("DISPLAY"):
        module = sys.modules["__main__"].__spec__
        program = ["-m", module.name] if module else sys.argv[:1]
        # A number that others are not about to take; a display that stays as its last window closes
        display = ["-a", "-n", str(100 + os.getpid() % 800), "-s", "-screen 0 1400x1100x24 -noreset"]
        sys.exit(subprocess.call(["xvfb-run", *display, sys.executable, *program, *sys.argv[1:]]))


def read(file):
    """A file .vtp as VTK has it."""
    from vtkmodules.vtkIOXML import vtkXMLPolyDataReader
    reader = vtkXMLPolyDataReader()
    reader.SetFileName(file)
    reader.Update()
    return reader.GetOutput()


def pointsOf(data):
    """Coordinates of the points of a surface or of lines, n x 3."""
    from vtkmodules.util.numpy_support import vtk_to_numpy
    return vtk_to_numpy(data.GetPoints().GetData()).astype(float)


def points(file):
    """The same of a file .vtp."""
    return pointsOf(read(file))


def shearModulus(case, group):
    """Gs of the membranes of a group [N/m]; None: it has none, or there is no OpenFOAM here. Capsules in capsules
    are the group <name>Nucleus."""
    return number(case, "bodies/%s/membrane/Gs" % group) or number(
        case, "bodies/%s/nucleus/membrane/Gs" % group[:-len("Nucleus")])


def number(case, entry):
    """A number of constant/deformableBodies with all variables replaced; None: not there, or there
    is no OpenFOAM here."""
    try:
        done = subprocess.run(["foamDictionary", "constant/deformableBodies", "-entry", entry, "-value"],
                              cwd=case.home, capture_output=True, text=True)
        return float(done.stdout.split()[-1]) if done.returncode == 0 else None
    except (OSError, ValueError, IndexError):
        return None


def fibreRadius(case, group):
    """Half the diameter of the fibres of a group [m]; 0.05 where there is no OpenFOAM here."""
    return 0.5 * (number(case, "bodies/%s/diameter" % group) or 0.1)


def box(case):
    """Smallest and largest coordinates of the mesh; None: there is none."""
    file = os.path.join(case.home, "constant/polyMesh/points")
    if not os.path.isfile(file):
        return None
    with open(file, "rb") as f:
        data = f.read()
    head = re.compile(rb"\n(\d+)\s*\(").search(data, data.index(b"}"))
    n = int(head[1])
    if re.search(rb"format\s+binary", data):
        x = np.frombuffer(data, "<f8", 3 * n, head.end()).reshape(n, 3)
    else:
        x = np.array(data[head.end():].replace(b"(", b" ").replace(b")", b" ").split()[:3 * n], float).reshape(n, 3)
    return x.min(0), x.max(0)


def colourTable(highest, name="viridis", lowest=0):
    """Colours of a map of matplotlib for values from the lowest to the highest."""
    import matplotlib
    import vtk
    table = vtk.vtkLookupTable()
    table.SetNumberOfTableValues(256)
    for i, rgba in enumerate(matplotlib.colormaps[name](np.linspace(0, 1, 256))):
        table.SetTableValue(i, *rgba)
    table.SetTableRange(lowest, highest)
    return table


def scaleBar(table, title, x, y, width=0.07, height=0.42, labels=4):
    """Bar of the colours of a table at a place of the picture, which counts from 0 to 1."""
    import vtk
    bar = vtk.vtkScalarBarActor()
    bar.SetLookupTable(table)
    bar.SetTitle(title)
    bar.SetNumberOfLabels(labels)
    bar.SetLabelFormat("%.2g")
    bar.SetPosition(x, y)
    bar.SetWidth(width)
    bar.SetHeight(height)
    bar.SetVerticalTitleSeparation(14)
    bar.SetMaximumNumberOfColors(256)
    bar.UnconstrainedFontSizeOn()
    for text in (bar.GetTitleTextProperty(), bar.GetLabelTextProperty()):
        text.SetColor(0, 0, 0)
        text.SetFontSize(18)
        text.BoldOff()
        text.ItalicOff()
        text.ShadowOff()
    return bar


def smooth(data):
    """A closed surface with 16 times as many triangles, rounded (Loop), with normals."""
    import vtk
    whole, triangles, fine, normals = (vtk.vtkCleanPolyData(), vtk.vtkTriangleFilter(),
                                       vtk.vtkLoopSubdivisionFilter(), vtk.vtkPolyDataNormals())
    whole.SetInputData(data)
    triangles.SetInputConnection(whole.GetOutputPort())
    fine.SetInputConnection(triangles.GetOutputPort())
    fine.SetNumberOfSubdivisions(2)
    normals.SetInputConnection(fine.GetOutputPort())
    normals.SplittingOff()
    normals.Update()
    return normals.GetOutput()


def save(renderers, size, picture, seenThrough=False):
    """Write what renderers show to a picture of a size [pixels]."""
    import vtk
    window = vtk.vtkRenderWindow()
    window.SetOffScreenRendering(1)
    window.SetSize(*size)
    window.SetMultiSamples(0 if seenThrough else 8)
    for renderer in renderers:
        if seenThrough:
            window.SetAlphaBitPlanes(1)
            renderer.SetUseDepthPeeling(1)
        window.AddRenderer(renderer)
    window.Render()
    image = vtk.vtkWindowToImageFilter()
    image.SetInput(window)
    image.ReadFrontBufferOff()
    writer = vtk.vtkPNGWriter()
    writer.SetFileName(picture)
    writer.SetInputConnection(image.GetOutputPort())
    writer.Write()


class View:
    """A picture in the making. size: of the picture [pixels]."""

    def __init__(self, case, size=(1300, 1000)):
        import vtk
        self.vtk, self.case, self.size = vtk, case, size
        self.scene = vtk.vtkRenderer()
        self.scene.SetBackground(1, 1, 1)
        self.highest = self.title = None
        self.seenThrough = False
        light = vtk.vtkLightKit()
        light.AddLightsToRenderer(self.scene)

    def actor(self, data):
        mapper, actor = self.vtk.vtkPolyDataMapper(), self.vtk.vtkActor()
        mapper.SetInputData(data)
        mapper.ScalarVisibilityOff()
        actor.SetMapper(mapper)
        look = actor.GetProperty()
        look.SetSpecular(0.15)
        look.SetSpecularPower(30)
        self.scene.AddActor(actor)
        return actor, mapper

    def add(self, group, file=None, colour=None, radius=None, opacity=1, highest=None, shift=(0, 0, 0)):
        """Bodies of a group, at the last time or of a file. radius: of tubes for fibres; highest:
        end of the scale of the tension over Gs, by default that of 99 % of the points."""
        from vtkmodules.util.numpy_support import vtk_to_numpy
        data = read(file or self.case.pictures(group)[-1][1])
        if data.GetNumberOfLines():
            tubes = self.vtk.vtkTubeFilter()
            tubes.SetInputData(data)
            tubes.SetRadius(radius or fibreRadius(self.case, group))
            tubes.SetNumberOfSides(16)
            tubes.CappingOn()
            tubes.Update()
            actor, _ = self.actor(tubes.GetOutput())
            actor.GetProperty().SetColor(*((0.36, 0.50, 0.66) if colour is None else colour))
        elif not data.GetPointData().HasArray("tension1"):
            actor, _ = self.actor(smooth(data))
            actor.GetProperty().SetColor(*((0.80, 0.62, 0.40) if colour is None else colour))
        else:
            Gs = shearModulus(self.case, group)
            tension = vtk_to_numpy(data.GetPointData().GetArray("tension1"))
            tension /= Gs or 1
            # A sphere at the start has round-off only
            self.highest = highest or self.highest or max(np.quantile(tension, 0.99), 1e-9 if Gs else 1e-300)
            self.title = "T / Gs" if Gs else "T [N/m]"
            actor, mapper = self.actor(smooth(data))
            mapper.ScalarVisibilityOn()
            mapper.SetScalarModeToUsePointFieldData()
            mapper.SelectColorArray("tension1")
            mapper.SetLookupTable(colourTable(self.highest))
            mapper.UseLookupTableScalarRangeOn()
        actor.GetProperty().SetOpacity(opacity)
        self.seenThrough = self.seenThrough or opacity < 1
        actor.SetPosition(*shift)
        return actor

    def label(self, words, place, size=20):
        """Words at a place in space."""
        label = self.vtk.vtkBillboardTextActor3D()
        label.SetInput(words)
        label.SetPosition(*place)
        label.GetTextProperty().SetColor(0, 0, 0)
        label.GetTextProperty().SetFontSize(size)
        self.scene.AddActor(label)

    def text(self, words, x, y, size=20):
        """Words in the picture."""
        label = self.vtk.vtkTextActor()
        label.SetInput(words)
        label.GetTextProperty().SetColor(0, 0, 0)
        label.GetTextProperty().SetFontSize(size)
        label.GetPositionCoordinate().SetCoordinateSystemToNormalizedViewport()
        label.SetPosition(x, y)
        self.scene.AddActor2D(label)

    def bar(self, x=0.9, y=0.3, height=0.42):
        """The colours of the tension."""
        width = 70 / self.size[0]
        self.scene.AddActor2D(scaleBar(colourTable(self.highest), self.title, x, y, width, height))

    def outline(self):
        """Edges of the box with its axes."""
        sides = box(self.case)
        if sides is None:
            return
        axes = self.vtk.vtkCubeAxesActor()
        axes.SetBounds(*np.ravel(np.transpose(sides)))
        axes.SetCamera(self.scene.GetActiveCamera())
        axes.SetFlyModeToOuterEdges()
        axes.SetTickLocationToOutside()
        low, high = sides

        # Numbers of small and large boxes are over a power of thousand, beside the name
        power = 3 * int(np.floor(np.log10((high - low).max()) / 3))
        unit = 1.0 if -3 <= power < 6 else 10.0**power
        middle, out = 0.5 * (low + high), 0.14 * (high - low).max()
        left = low[0] - (1 if unit == 1 else 1.8) * out
        places = {"x": (middle[0], low[1] - out, high[2]), "y": (left, middle[1], high[2]),
                  "z": (high[0] + out, low[1], middle[2])}
        for i, name in enumerate("xyz"):
            axes.GetLabelTextProperty(i).SetColor(0, 0, 0)
            getattr(axes, "Set%sTitle" % name.upper())("")
            getattr(axes, "Get%sAxesLinesProperty" % name.upper())().SetColor(0.35, 0.35, 0.35)
            getattr(axes, "%sAxisMinorTickVisibilityOff" % name.upper())()
            getattr(axes, "Set%sAxisRange" % name.upper())(low[i] / unit, high[i] / unit)
            self.label(name if unit == 1 else "%s / %g" % (name, unit), places[name], 24)
        axes.SetUse2DMode(1)
        self.scene.AddActor(axes)
        edges = self.vtk.vtkOutlineSource()
        edges.SetBounds(*np.ravel(np.transpose(sides)))
        edges.Update()
        actor, _ = self.actor(edges.GetOutput())
        actor.GetProperty().SetColor(0.35, 0.35, 0.35)
        actor.GetProperty().LightingOff()

    def look(self, direction=(0.42, 0.32, 1.2), zoom=1.32):
        """From a direction, at everything."""
        camera = self.scene.GetActiveCamera()
        camera.SetFocalPoint(0, 0, 0)
        camera.SetPosition(*direction)
        camera.SetViewUp(0, 1, 0)
        camera.SetViewAngle(22)
        self.scene.ResetCamera()
        camera.Zoom(zoom)
        camera.SetWindowCenter(0.07 if self.title else 0, -0.05)
        self.scene.ResetCameraClippingRange()

    def write(self, picture):
        save([self.scene], self.size, picture, self.seenThrough)


def suspension(case, picture, radius=None):
    """All bodies at the last time. radius: of fibres [m], by default half their diameter.
    Membranes around nuclei are seen through; of several groups of fibres
    each has a colour, in the order of their names."""
    from . import figures
    view = View(case)

    # Groups that a run has no longer may have pictures of earlier times
    last = max(case.pictures(group)[-1][0] for group in case.groups())
    groups = [group for group in case.groups() if case.pictures(group)[-1][0] >= (1 - 1e-9) * last]
    kinds = {group: read(case.pictures(group)[-1][1]) for group in groups}
    fibres = [group for group in groups if kinds[group].GetNumberOfLines()]
    shades = figures.shades(fibres) if len(fibres) > 1 else {}
    opacity = 0.4 if any("Nucleus" in group for group in groups) else 1
    for group in groups:
        membrane = kinds[group].GetPointData().HasArray("tension1")
        view.add(group, colour=shades[group][:3] if group in shades else None, radius=radius,
                 opacity=opacity if membrane else 1)
    view.outline()
    view.text("t = %g" % last, 0.02, 0.02)
    if view.title:
        view.bar()
    sides = box(case)
    tall = sides is not None and np.ptp(sides, axis=0).max() > 1.5 * np.ptp(sides, axis=0)[:2].min()
    view.look(zoom=1.05 if tall else 1.32)
    view.write(picture)


def strip(case, picture, group, size=None, perRow=4):
    """The only body of a group at several times in two rows, seen along z, with a ball on the
    point that is at the tip at the start. size: of the square that a body has to itself [m];
    None: 1.25 times its longest side. The scale ends where 99 % of the points of the tensest
    frame are below."""
    import vtk
    from vtkmodules.util.numpy_support import vtk_to_numpy
    all_ = case.pictures(group)
    chosen = [all_[i] for i in np.unique(np.linspace(0, len(all_) - 1, 2 * perRow).astype(int))]
    size = size or 1.25 * max(np.ptp(points(file)[:, :2], axis=0).max() for _, file in chosen)
    view = View(case, (int(520 * perRow / 1.9) + 150, 580))
    tension = lambda file: vtk_to_numpy(read(file).GetPointData().GetArray("tension1"))
    highest = max(np.percentile(tension(file), 99) for _, file in chosen) / (shearModulus(case, group) or 1)
    tip = points(chosen[0][1])[:, 0].argmax()
    for k, (time, file) in enumerate(chosen):
        middle = points(file).mean(0)
        at = np.array((size * (k % perRow), -1.1 * size * (k // perRow), 0)) - middle
        view.add(group, file, highest=highest, shift=at)
        ball = vtk.vtkSphereSource()
        ball.SetCenter(*(points(file)[tip] + at))
        ball.SetRadius(0.035 * size)
        ball.SetThetaResolution(24)
        ball.SetPhiResolution(24)
        ball.Update()
        view.actor(ball.GetOutput())[0].GetProperty().SetColor(0.8, 0.25, 0.1)
        view.label("t = %g" % time, at + middle + size * np.array((-0.25, -0.55, 0)))
    view.bar(1 - 130 / view.size[0], 0.28)
    camera = view.scene.GetActiveCamera()
    camera.ParallelProjectionOn()
    middle = (0.5 * (perRow - 1) * size + 0.15 * size, -0.58 * size)
    camera.SetPosition(*middle, 20 * size)
    camera.SetFocalPoint(*middle, 0)
    camera.SetViewUp(0, 1, 0)
    camera.SetParallelScale(1.12 * size)
    view.scene.ResetCameraClippingRange()
    view.write(picture)
