"""The command line of ``python3 -m vtkhaptics``."""

import argparse
import math

from . import vtkHapticDevice
from .devices import known_devices, list_devices, remembered_device
from .surfaces import FORMATS
from .units import METRES

SIDES = ("auto", "front", "both")

EPILOG = """examples:
  python3 -m vtkhaptics gearbox.stl
      touch it with the mouse: hold space to press, move to stroke, ? lists the keys
  python3 -m vtkhaptics head.nii.gz --contour 500 --landmarks points.csv
      the contour of an image at a value; what d drops is written at the end
  python3 -m vtkhaptics pial.vtp --scalars Sulc --device simulated
      a simulated hand strokes it; values are coloured
  python3 -m vtkhaptics skull.vtp vessel.stl --stiffness 800 --side both
      two surfaces at once, harder, touched from inside too; x carries the one that is touched
  python3 -m vtkhaptics t13.stl --offscreen --screenshot t13.png --trace t13.vtp
      no window: a picture and the trace, one point a tick
  python3 -m vtkhaptics t13.stl --device t13.vtp
      touch along a recorded path again

without a window (--offscreen) time is virtual, so that every run gives the same picture; nobody
moves the mouse there, so it strokes across the middle of the view by itself.

a large surface is prepared while the window shows it already, with the progress at the lower left;
closing the window gives it up.

few files name their length unit (glTF, DICOM, NIfTI and GIfTI do): sizes are shown in the file's own, or
with that of --unit, and the hand's space is fitted to them.

exit status:
  0 done; 1 the device or the servo failed, a simulated hand met no surface, or a file could not be written;
  2 wrong arguments, or a surface or recording that cannot be read; 3 no display to draw with; 130, 143, 129 ended by Ctrl-C (SIGINT),
  SIGTERM or SIGHUP, with the results until then, where the surfaces had been ready

where nobody reads what is printed (`| head -1`), the rest is dropped, and nothing else changes; a full disk
behind it gives 1, with all files written
"""


class ListDevices(argparse.Action):
    """Prints the devices and ends the program."""

    def __call__(self, parser, _namespace, _values, _option=None):
        for name, state in list_devices():
            print(f"{name:<16}  {state}")
        parser.exit()


def _named(text):
    """What an option names, which a variable of a shell that is not set would leave empty."""
    if not text:
        raise argparse.ArgumentTypeError("is empty; give a name")
    return text


def make_parser(program, **texts):
    """A parser without options, which takes no empty text for one."""
    parser = argparse.ArgumentParser(
        prog=f"python3 -m {program}", formatter_class=argparse.RawDescriptionHelpFormatter, **texts)
    parser.register("type", None, _named)
    return parser


def add_seconds(parser, default, what):
    """Adds the option --seconds, which check_seconds() checks."""
    parser.add_argument(
        "--seconds",
        type=float,
        default=default,
        metavar="S",
        help=f"{what}, 2 to 600 (default {default:g})",
    )


def check_seconds(parser, options):
    """Exits with 2 where --seconds is out of range."""
    if not 2.0 <= options.seconds <= 600.0:
        parser.error(f"--seconds {options.seconds:g} is out of range; give 2 to 600")


def parse(arguments):
    """The options of a command line; exits with 2 where they are wrong."""
    parser = make_parser(
        "vtkhaptics", description="Touch surfaces from files, at 1000 forces a second.", epilog=EPILOG)
    parser.add_argument(
        "surfaces",
        nargs="+",
        metavar="SURFACE",
        help="what to touch: " + ", ".join(FORMATS) + ", also with .gz behind, FreeSurfer's "
        "(lh.pial), or a folder with the slices of a DICOM image; of meshes and images the outside, see --contour",
    )
    parser.add_argument(
        "--contour",
        type=float,
        metavar="VALUE",
        help="touch where the values of a mesh or an image are so, not its outside",
    )
    parser.add_argument(
        "--device",
        metavar="NAME[:ID]",
        help="what the hand holds: mouse, simulated, falcon, haply, openhaptics, forcedimension, "
        "spacemouse, or a recording: a .vtp as --trace writes it (default: the device of the last "
        "time, the mouse at first). Drivers were tested without hardware: see Devices/README.md",
    )
    parser.add_argument(
        "--list-devices",
        nargs=0,
        action=ListDevices,
        help="print what is plugged in or running, each with its state, and end",
    )
    parser.add_argument(
        "--force-limit",
        type=float,
        metavar="N",
        help="no force is larger [N], 0 to 50; 2 for a device that is new to you (its default)",
    )
    parser.add_argument(
        "--stiffness",
        type=float,
        default=500.0,
        metavar="K",
        help="of the surfaces in the hand [N/m], above 0, up to 1e6 (default 500)",
    )
    parser.add_argument(
        "--stiffness-array",
        metavar="ARRAY",
        help="point or cell array with the stiffness of each place [N/m]",
    )
    parser.add_argument(
        "--tip-radius",
        type=float,
        default=0.0,
        metavar="M",
        help="of the ball that touches [m], in the hand: it rounds edges and comes into no gap narrower than "
        "itself; 0, the default, is a point",
    )
    parser.add_argument(
        "--substeps",
        type=int,
        default=1,
        metavar="N",
        help="in how many substeps a tick may follow the hand's way since the tick before, 1 to 16 (default 1: off; "
        "4 are enough), on rough ground and in folds, where the contact else depends on how often the hand is sampled",
    )
    parser.add_argument(
        "--friction",
        type=float,
        default=0.0,
        metavar="MU",
        help="coefficient at which the hand breaks away, 0 to 10 (default 0); it slides with 0.8 of it",
    )
    parser.add_argument(
        "--friction-array", metavar="ARRAY", help="point or cell array with the coefficient"
    )
    parser.add_argument(
        "--firmware", metavar="FILE", help="what a Falcon is given that has none yet"
    )
    parser.add_argument(
        "--unit",
        choices=METRES,
        help="length unit of the files, for what is printed, shown and written: " + ", ".join(METRES)
        + " (default: the one that a file names)",
        metavar="NAME",
    )
    parser.add_argument(
        "--side",
        choices=SIDES,
        default="auto",
        help="which side can be touched: auto (default; the front of closed surfaces, both of open "
        "ones), front or both",
    )
    parser.add_argument(
        "--scalars",
        metavar="ARRAY",
        help="point or cell array to colour by (default: the active one, or else the first that "
        "holds values; 'none' for no colours)",
    )
    parser.add_argument(
        "--screenshot", metavar="FILE", help="write a PNG of the end, or when the window is closed"
    )
    parser.add_argument("--trace", metavar="FILE", help="write the trace as .vtp")
    parser.add_argument(
        "--landmarks", metavar="FILE", help="write what d has dropped as .csv: place, values, label"
    )
    parser.add_argument("--offscreen", action="store_true", help="open no window")
    add_seconds(parser, 8.0, "how long a simulated hand strokes, or an off-screen run takes")
    parser.add_argument(
        "--size",
        type=int,
        nargs=2,
        default=(1200, 800),
        metavar=("W", "H"),
        help="of the picture [pixel], 100 to 8000 (default 1200 800)",
    )
    options = parser.parse_args(arguments)
    if not 0.0 < options.stiffness <= 1e6:
        parser.error(
            f"--stiffness {options.stiffness:g} is out of range; give a number above 0, up to 1e6 N/m"
        )
    if not 0.0 <= options.tip_radius <= 1.0:
        parser.error(f"--tip-radius {options.tip_radius:g} is out of range; give 0 to 1 m")
    if not 1 <= options.substeps <= 16:
        parser.error(f"--substeps {options.substeps} is out of range; give 1 to 16")
    if not 0.0 <= options.friction <= 10.0:
        parser.error(f"--friction {options.friction:g} is out of range; give 0 to 10")
    if options.contour is not None and not math.isfinite(options.contour):
        parser.error(f"--contour {options.contour:g} is no value; give a number")
    options.is_remembered = options.device is None and not options.offscreen
    if options.device is None:
        options.device = "mouse" if options.offscreen else remembered_device()
    if options.force_limit is not None and not 0.0 <= options.force_limit <= 50.0:
        parser.error(f"--force-limit {options.force_limit:g} is out of range; give 0 to 50 N")
    if options.device.partition(":")[0] in (name for name, _ in known_devices()):
        problem = vtkHapticDevice.GetNameProblem(options.device)
        if problem:
            parser.error(f"--device {options.device}: {problem}")
    if options.firmware and options.device.partition(":")[0] != "falcon":
        parser.error("--firmware is for --device falcon")
    check_seconds(parser, options)
    if not all(100 <= pixels <= 8000 for pixels in options.size):
        parser.error(f"--size {options.size[0]} {options.size[1]} is out of range; give 100 to 8000")
    for name, extension in (("screenshot", ".png"), ("trace", ".vtp"), ("landmarks", ".csv")):
        path = getattr(options, name)
        if path and not path.lower().endswith(extension):
            parser.error(f"--{name} {path}: its name must end in {extension}")
    return options
