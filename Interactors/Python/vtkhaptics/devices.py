"""Devices by the names that the viewer and ParaView know them by."""

from __future__ import annotations

import configparser
import os

from vtkmodules.vtkCommonCore import vtkStringArray

from . import vtkHapticsDevices
from .errors import HapticsError
from .output import whole_file

_SECTION, _KEY = "viewer", "device"


def create_device(name: str) -> vtkHapticsDevices.vtkHapticDevice:
    """A device by its name, NAME or NAME:ID, such as ``"mouse"``, ``"falcon:1"`` or ``"haply:049D"``.

    It is not open yet. Raises HapticsError, with the names that there are, where there is none.

        scene.SetDevice(vtkhaptics.create_device("haply"))
    """
    base = vtkHapticsDevices.vtkHapticDevice
    problem = base.GetNameProblem(name)
    if problem:
        raise HapticsError(problem, None, problem)
    return base.CreateByName(name)


def list_devices() -> list[tuple[str, str]]:
    """What is plugged in or running: (name for create_device(), state in a sentence) of each.

    A kind of device of which there is none is listed too, with what is missing. Nothing is opened,
    moved or given force.
    """
    names, states = vtkStringArray(), vtkStringArray()
    vtkHapticsDevices.vtkHapticDevice.ListDevices(names, states)
    return _pairs(names, states)


def known_devices() -> list[tuple[str, str]]:
    """What create_device() can make: (name, title) of each kind."""
    names, titles = vtkStringArray(), vtkStringArray()
    vtkHapticsDevices.vtkHapticDevice.GetKnownNames(names, titles)
    return _pairs(names, titles)


def _pairs(first, second):
    return [(first.GetValue(i), second.GetValue(i)) for i in range(first.GetNumberOfValues())]


def _file():
    base = os.environ.get("XDG_CONFIG_HOME") or os.path.expanduser("~/.config")
    return os.path.join(base, "vtkhaptics", "viewer.ini")


def remembered_device():
    """The name of the device that the viewer used last; the mouse where there is none."""
    config = configparser.ConfigParser(interpolation=None)
    try:
        config.read(_file(), encoding="utf-8")
        name = config.get(_SECTION, _KEY, fallback="mouse")
    except (configparser.Error, OSError, UnicodeDecodeError):
        return "mouse"  # a file that somebody has damaged
    return name if not vtkHapticsDevices.vtkHapticDevice.GetNameProblem(name) else "mouse"


def remember_device(name):
    """Remembers a device for the next time. Where it cannot, the next time begins with the mouse."""
    if name == remembered_device():
        return
    config = configparser.ConfigParser(interpolation=None)
    config[_SECTION] = {_KEY: name}
    try:
        os.makedirs(os.path.dirname(_file()), exist_ok=True)
        with whole_file(_file(), text=True) as file:
            config.write(file)
    except OSError:
        return
