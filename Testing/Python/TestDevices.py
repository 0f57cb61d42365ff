"""Devices by name: what can be made, what is listed, and which one the viewer remembers."""

import contextlib
import io
import os
import tempfile

import vtkhaptics
from vtkhaptics.arguments import parse
from vtkhaptics.devices import remember_device, remembered_device


def test_names():
    names = [name for name, _ in vtkhaptics.known_devices()]
    assert {"mouse", "simulated", "falcon"} <= set(names), names
    for name in names:
        assert isinstance(vtkhaptics.create_device(name), vtkhaptics.vtkHapticDevice), name
    falcon = vtkhaptics.create_device("falcon:3")
    assert falcon.GetDeviceIndex() == 3 and falcon.GetDeviceId() == "3"
    assert not vtkhaptics.create_device("mouse").GivesForce()
    for wrong in ("phantom", "falcon:x", "mouse:1", ""):
        try:
            vtkhaptics.create_device(wrong)
        except vtkhaptics.HapticsError as error:
            assert "no device" in str(error) or "no id" in str(error), error
        else:
            raise AssertionError(wrong)


def test_listing():
    listed = vtkhaptics.list_devices()
    kinds = {name.partition(":")[0] for name, _ in listed}
    assert kinds == {name for name, _ in vtkhaptics.known_devices()}, kinds
    assert all(state for _, state in listed)
    out = io.StringIO()
    try:
        with contextlib.redirect_stdout(out):
            parse(["--list-devices"])
    except SystemExit as end:
        assert end.code == 0
    for name, state in listed:
        assert name in out.getvalue() and state[:40] in out.getvalue(), (name, out.getvalue())


def test_without_hardware_each_says_what_helps():
    os.environ["HAPTICS_HAPLY_PORT"] = "1"
    os.environ["SPNAV_SOCKET"] = "/nowhere"
    states = dict(vtkhaptics.list_devices())
    words = {
        "haply": "systemctl start",
        "openhaptics": "Install 3D Systems' OpenHaptics",
        "forcedimension": "Install Force Dimension's SDK",
        "spacemouse": "spacenavd",
        "falcon": "plugged in",
    }
    for name, part in words.items():
        if name in states:
            assert part in states[name], (name, states[name])


def test_the_last_one_is_remembered():
    with tempfile.TemporaryDirectory() as folder:
        os.environ["XDG_CONFIG_HOME"] = folder
        assert remembered_device() == "mouse"
        assert parse(["a.stl"]).device == "mouse"
        remember_device("falcon:2")
        assert remembered_device() == "falcon:2"
        options = parse(["a.stl"])
        assert options.device == "falcon:2" and options.is_remembered
        assert parse(["a.stl", "--offscreen"]).device == "mouse"
        assert not parse(["a.stl", "--device", "falcon:2"]).is_remembered
        file = os.path.join(folder, "vtkhaptics", "viewer.ini")
        for damage in (b"\xff\xfe[", b"device = falcon", b"[viewer]\ndevice = gone\n"):
            with open(file, "wb") as stream:
                stream.write(damage)
            assert remembered_device() == "mouse", damage
        remember_device("falcon")
        assert remembered_device() == "falcon"
        os.chmod(os.path.join(folder, "vtkhaptics"), 0o500)
        remember_device("mouse")  # where it cannot be written, nothing fails
        os.chmod(os.path.join(folder, "vtkhaptics"), 0o700)


test_names()
test_listing()
test_without_hardware_each_says_what_helps()
test_the_last_one_is_remembered()
print("devices by name: ok")
