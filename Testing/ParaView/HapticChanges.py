"""Surfaces of ParaView that change under a stroking hand, each with an oracle that knows where the
hand has to be. Everything is in virtual time: FRAME ticks of 1 ms between two pictures.

A field whose value is known in closed form has the touched surface as one of its level sets, and is
lower outside. So a god-object lies on the surface where field == level, and has been let through
where field > level.
"""

import contextlib
import os

import numpy as np
from HapticSceneTesting import haptics, trace_arrays, write_points
from paraview import simple
from vtkmodules.util.misc import calldata_type
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.util.vtkConstants import VTK_STRING
from vtkmodules.vtkCommonCore import vtkOutputWindow, vtkPoints
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkFiltersCore import vtkProbeFilter
from vtkmodules.vtkImagingCore import vtkRTAnalyticSource

FRAME = 33  # ticks between two pictures
DELAY = 3  # frames, 0.1 s: a surface that deforms is after them where it was sent
SCALE = 200.0  # world units a metre of the device
STIFFNESS = 400.0
PATCH_RADIUS = 3.0  # [world unit]: a patch is a small part of what is touched


class Change:
    """A source that changes, and a hand on it.

    pipeline: makes the source to touch; returns its proxies, that one first.
    drive(source, on_frame): shows one frame after another, and calls on_frame() after each.
    path(seconds): where the hand is then, world frame.
    field(points): see above.
    levels: of the surface at first and in each frame; None where it is empty.
    tolerance: how far the field on the facets is from the level.
    is_convex: so that a hand outside cannot be held back by anything.
    deforms: whether it is the same triangles all the time.
    """

    def __init__(self, pipeline, drive, path, field, levels, tolerance, is_convex=False, deforms=False):
        self.pipeline, self.drive, self.path = pipeline, drive, path
        self.field, self.levels = field, list(levels)
        self.tolerance, self.is_convex, self.deforms = tolerance, is_convex, deforms

    def write_path(self, file):
        """The hand's path as a file that a Device takes."""
        seconds = 0.001 * np.arange(FRAME * len(self.levels) + 1)
        write_points(file, [self.path(second) for second in seconds], seconds)


class Ticks:
    """What a hand met while a surface changed: one value a tick."""

    def __init__(self, change, hand, complaints):
        self.arrays = trace_arrays(hand)
        self.touching = self.arrays["ActiveConstraints"] > 0
        self.hand = change.field(self.arrays["HapticInterfacePoint"])
        self.place = change.field(self.arrays["GodObject"])
        self.force_steps = force_steps(self.arrays["Force"])
        self.force_growth = np.diff(np.linalg.norm(self.arrays["Force"], axis=1))
        preparation = hand.vtk.GetSurfaceFilter(hand.vtk.GetSurfaces().GetId(0))
        self.builds = preparation.GetNumberOfBuilds()
        self.complaints = complaints


def force_steps(force):
    """By how much each force has grown or turned: its distance from the line of zero to the last."""
    last, now = force[:-1], force[1:]
    squared = np.maximum((last * last).sum(axis=1), 1e-30)
    share = np.clip((last * now).sum(axis=1) / squared, 0.0, 1.0)
    return np.linalg.norm(now - share[:, np.newaxis] * last, axis=1)


def level_range(change):
    """The lowest and the highest level that may be touched in each tick; -inf and inf: none."""
    memory = DELAY if change.deforms else 0
    ranges = []
    for frame, level in enumerate(change.levels):
        recent = change.levels[max(0, frame - memory):frame + 1]
        ranges.append((-np.inf, np.inf) if level is None else (min(recent), max(recent)))
    return np.repeat(ranges, FRAME, axis=0).T


@contextlib.contextmanager
def touched(change, remote=False, in_patches=False):
    """A hand on a change, in a view of its own: hand, source, and a list of what it complains of."""
    view = simple.CreateView("RenderView")
    view.ViewSize = [300, 200]
    view.RemoteRenderThreshold = 0.0 if remote else 1e6
    view.CameraPosition = [0.0, -10.0, 40.0]
    proxies = change.pipeline()
    hand = haptics.scene()
    file = os.path.abspath(f"HapticChanges_{os.getpid()}.vtp")
    change.write_path(file)
    complaints = []
    window = vtkOutputWindow.GetInstance()
    observers = [window.AddObserver(event, _listener(complaints))
                 for event in ("ErrorEvent", "WarningEvent")]
    try:
        hand.set(Device=file, Stiffness=STIFFNESS, Side="Automatic", RecordTrace=0)
        display = hand.touch(proxies[0], view)
        if in_patches:
            display.PatchThreshold, display.PatchRadius = 0, PATCH_RADIUS
        hand.WorkspaceTransform = np.diag([SCALE, SCALE, SCALE, 1.0]).ravel().tolist()
        hand.RecordTrace = 1
        yield hand, proxies[0], complaints
    finally:
        for observer in observers:
            window.RemoveObserver(observer)
        hand.release()
        hand.set(RecordTrace=0, Surfaces=[], Device="none")
        os.remove(file)
        simple.Delete(view)
        for proxy in proxies:
            simple.Delete(proxy)


def _listener(complaints):
    @calldata_type(VTK_STRING)
    def listen(_caller, _event, text):
        complaints.append(text)

    return listen


def follow(change, remote=False, in_patches=False):
    """What a hand meets of a change, in virtual time."""
    with touched(change, remote, in_patches) as (hand, source, complaints):

        def on_frame():
            try:
                hand.step(FRAME)
            except haptics.HapticsError:  # among the complaints; the ticks are done all the same
                pass

        on_frame()
        change.drive(source, on_frame)
        return Ticks(change, hand, complaints)


# --- drives ---------------------------------------------------------------------------------------


def scrub(times):
    """Goes to times, in any order."""

    def drive(_source, on_frame):
        for time in times:
            simple.GetAnimationScene().AnimationTime = time
            on_frame()

    return drive


def play(_source, on_frame):
    """Plays the animation."""
    scene, view = simple.GetAnimationScene(), simple.GetActiveView().SMProxy
    scene.PlayMode = "Snap To TimeSteps"
    observer = view.AddObserver("EndEvent", lambda *_: on_frame())
    scene.Play()
    view.RemoveObserver(observer)


def drag(values):
    """Drags the value of a contour."""

    def drive(source, on_frame):
        for value in values:
            source.Isosurfaces = [value]
            simple.Render(simple.GetActiveView())
            on_frame()

    return drive


# --- sources --------------------------------------------------------------------------------------

TIMES = range(11)


def radius(time):
    """Of the balls below [world unit]: 10, and up to 0.5 (2.5 mm in the hand) more or less."""
    return 10.0 + 0.5 * np.sin(0.9 * time)


TIME_STEPS = f"""
executive = self.GetExecutive()
information = executive.GetOutputInformation(0)
times = {[float(time) for time in TIMES]}
information.Set(executive.TIME_STEPS(), times, len(times))
information.Set(executive.TIME_RANGE(), [times[0], times[-1]], 2)
"""
# ParaView runs them among the names of the main script.
BREATHING_POINTS = """
def breathe(self, input, output):
    import numpy as np
    from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
    from vtkmodules.vtkCommonCore import vtkPoints
    executive = self.GetExecutive()
    time = executive.GetOutputInformation(0).Get(executive.UPDATE_TIME_STEP())
    radius = 10.0 + 0.5 * np.sin(0.9 * time)
    output.ShallowCopy(input)
    if input.GetPoints():
        points = vtkPoints()
        points.SetData(numpy_to_vtk(radius * vtk_to_numpy(input.GetPoints().GetData()), deep=True))
        output.SetPoints(points)

breathe(self, self.GetInput(), self.GetOutput())
"""
BREATHING_FIELD = """
def breathe(self, input, output):
    import numpy as np
    from vtkmodules.util.numpy_support import numpy_to_vtk
    executive = self.GetExecutive()
    time = executive.GetOutputInformation(0).Get(executive.UPDATE_TIME_STEP())
    radius = 10.0 + 0.5 * np.sin(0.9 * time)
    output.ShallowCopy(input)
    places = np.array([input.GetPoint(i) for i in range(input.GetNumberOfPoints())]).reshape(-1, 3)
    inside = numpy_to_vtk(radius - np.linalg.norm(places, axis=1), deep=True)
    inside.SetName("inside")
    output.GetPointData().AddArray(inside)

breathe(self, self.GetInput(), self.GetOutput())
"""


def timed(source, script):
    filter_ = simple.ProgrammableFilter(
        Input=source, RequestInformationScript=TIME_STEPS, Script=script)
    filter_.UpdatePipelineInformation()
    scene = simple.GetAnimationScene()
    scene.UpdateAnimationUsingDataTimeSteps()
    scene.GoToFirst()  # and not AnimationTime = 0, which playing does not change
    return filter_


def breathing_ball():
    """The same triangles in each time step."""
    sphere = simple.Sphere(Radius=1.0, ThetaResolution=64, PhiResolution=64)
    return [timed(sphere, BREATHING_POINTS), sphere]


def breathing_contour():
    """Other triangles in each time step."""
    wavelet = simple.Wavelet(WholeExtent=[-12, 12, -12, 12, -12, 12])
    field = timed(wavelet, BREATHING_FIELD)
    contour = simple.Contour(Input=field, ContourBy=["POINTS", "inside"], Isosurfaces=[0.0])
    return [contour, field, wavelet]


def bumpy_contour(value):
    def pipeline():
        wavelet = simple.Wavelet()
        contour = simple.Contour(
            Input=wavelet, ContourBy=["POINTS", "RTData"], Isosurfaces=[value])
        return [contour, wavelet]

    return pipeline


def above_centre(points):
    """Less, the farther outside."""
    return -np.linalg.norm(points, axis=1)


def wavelet_value(points):
    """Of the source Wavelet, by VTK, linear in its cells."""
    places = vtkPolyData()
    places.SetPoints(vtkPoints())
    places.GetPoints().SetData(numpy_to_vtk(points, deep=True))
    source = vtkRTAnalyticSource()
    probe = vtkProbeFilter()
    probe.SetInputData(places)
    probe.SetSourceConnection(source.GetOutputPort())
    probe.Update()
    return np.array(vtk_to_numpy(probe.GetOutput().GetPointData().GetArray("RTData")))


# --- hands ----------------------------------------------------------------------------------------


def circle(height, seconds):
    """From above down to a distance from the centre in 0.1 s, then round and round at 0.1 m/s."""
    down = max(height, 13.0 - (13.0 - height) * seconds / 0.1)
    angle = 20.0 / 6.0 * seconds
    tilt = np.array([6.0 / height * np.cos(angle), 6.0 / height * np.sin(angle)])
    return [down * tilt[0], down * tilt[1], down * np.sqrt(1.0 - tilt @ tilt)]


def dip(seconds):
    """Down onto the contours below and off them again, three times. It is off where they are empty:
    around a hand that an open surface appears at there is no side that it was on."""
    outside, inside = 13.0, 6.2
    frames = [0, 3, 6, 8, 22, 24, 26, 40, 42]
    heights = [outside, inside, inside, outside, inside, inside, outside, inside, inside]
    height = np.interp(seconds, 0.001 * FRAME * np.array(frames), heights)
    return height / inside * np.array(circle(inside, 0.1 + seconds))


# --- changes --------------------------------------------------------------------------------------

SCRUBBED = [1, 2, 3, 4, 3, 2, 1, 0, 7, 2, 10, 9, 8, 0, 5, 5, 10]
NOTCH = [float(value) for value in range(228, 203, -2)]
OFFSETS = [0.1, 0.2, 0.3, 0.4, 0.5, 0.3, -0.1, -0.5, -0.4, -0.3, -0.2, -0.1]
SMALL = [202.0, 204.0, 206.0, 208.0, 210.0, 207.0, 204.0, 201.0, 198.0, 200.0]
LARGE = [230.0, 200.0, 215.0, 245.0, 260.0, 205.0, 200.0]
EMPTY = [200.0] * 5 + [1e9] * 2 + [205.0] * 16 + [-1e9] * 2 + [200.0] * 16


def changes():
    """All changes, by name."""
    stroke = lambda seconds: circle(9.0, seconds)
    ball = dict(path=stroke, field=above_centre, is_convex=True)
    # Facets of 1/64 of a turn lie up to 0.025 inside the ball.
    deforming = dict(pipeline=breathing_ball, tolerance=0.03, deforms=True, **ball)
    # The field's second derivative is 1/radius in two directions, over cells of 1.
    series = dict(pipeline=breathing_contour, tolerance=0.06, **ball)
    of_times = lambda times: [-radius(time) for time in times]
    made = {}
    for name, source in (("deforming", deforming), ("series", series)):
        made[f"{name}_played"] = Change(
            drive=play, levels=of_times([0, *TIMES]), **source)
        made[f"{name}_scrubbed"] = Change(
            drive=scrub(SCRUBBED), levels=of_times([0, *SCRUBBED]), **source)
    made["dragged_ball"] = Change(
        drive=drag(OFFSETS), levels=[-10.0] + [offset - 10.0 for offset in OFFSETS], **series)
    # Two lobes grow into one where the hand is between them.
    made["dragged_notch"] = Change(
        pipeline=bumpy_contour(230.0), drive=drag(NOTCH),
        path=lambda seconds: [0.0, -3.956, max(0.241, 4.0 - 60.0 * seconds)],
        field=wavelet_value, levels=[230.0] + NOTCH, tolerance=0.2)
    for name, values, path in (("small", SMALL, lambda seconds: circle(6.2, seconds)),
                               ("large", LARGE, lambda seconds: circle(6.2, seconds)),
                               ("empty", EMPTY, dip)):
        made[f"dragged_{name}"] = Change(
            pipeline=bumpy_contour(200.0), drive=drag(values), path=path, field=wavelet_value,
            levels=[200.0] + [value if abs(value) < 1e8 else None for value in values],
            tolerance=0.2)
    return made
