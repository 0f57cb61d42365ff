"""A device of one's own: derive from :class:`HapticDevice`, or write to a :class:`SharedHand`.

In the same process, a thread calls ``exchange(force)`` a thousand times a second::

    class Pen(vtkhaptics.HapticDevice):
        def exchange(self, force):        # (3,) [N] -> position (3,) [m], or (position, buttons)
            self.motors.pull(force)
            return self.encoders.read()

    scene.SetDevice(Pen())

In a process of its own, which no other Python code holds up, over a file in memory::

    # the process that drives the device, which needs sharing.py and NumPy, and no VTK
    memory = np.memmap("/dev/shm/pen", np.float64, "w+", shape=16)
    hand = SharedHand(memory)
    while True:
        force = hand.exchange(position)

    # the process that touches
    device = vtkhaptics.vtkSharedHapticDevice()
    vtkhaptics.share(device, np.memmap("/dev/shm/pen", np.float64, "r+", shape=16))

:class:`SharedHand` needs NumPy alone: ``vtkhaptics/sharing.py`` can be copied to where VTK is not.

How regular Python is depends on what else it does, see Devices/README.md for what was measured. It
matters to the forces, and never to safety: a position that comes late by more than Timeout
(20 ms), that is not finite, or an exception here ends the servo's run with zero force at once.
"""

import threading
import time
from typing import Any, Optional

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk

from . import vtkSharedHapticDevice
from .sharing import SharedHand


class HapticDevice(vtkSharedHapticDevice):
    """A haptic device whose program is in Python: derive from it and give exchange().

    It opens like every device, by its Open() or where a scene engages, and then a thread calls
    exchange() `rate` times a second until Close(), which has to be called for the thread to
    end. Limits are set as for every vtkSharedHapticDevice: SetMaximumForce() and so on, before
    it opens. What connect() raises fails Open(); what exchange() raises loses the device: the
    servo's force is zero at its next tick, and the exception is the cause of the HapticsError
    that the scene raises.
    """

    rate = 1000.0  # [Hz]
    failure: Optional[BaseException] = None  # what connect() or exchange() raised

    def __init__(self) -> None:
        super().__init__()
        self._thread = None
        self._end = threading.Event()
        self.AddObserver("StateChangedEvent", _on_state)

    def connect(self) -> None:
        """Called when the device opens, before the first exchange(). GUI thread."""

    def exchange(self, force: np.ndarray) -> Any:
        """Gives the hand a force, (3,) [N], and returns where it is, (3,) [m], or that and its
        buttons (bit i is button i): device frame. In the device's thread, `rate` times a
        second; the first time in the GUI thread, with no force."""
        raise NotImplementedError(f"{type(self).__name__} has no exchange(force)")

    def disconnect(self) -> None:
        """Called when the device closes, after the last exchange(). GUI thread."""

    def _start(self):
        self.failure = None
        self._end = threading.Event()
        try:
            self.connect()
            position, buttons = _sample(self.exchange(np.zeros(3)))
        except Exception as error:
            self.failure = error
            return
        force = np.array(self.Exchange(position, buttons))
        self._thread = threading.Thread(
            target=self._run, args=(force,), daemon=True, name=type(self).__name__
        )
        self._thread.start()

    def _run(self, force):
        period = 1.0 / self.rate
        due = time.monotonic()
        try:
            while not self._end.is_set():
                position, buttons = _sample(self.exchange(force))
                force = np.array(self.Exchange(position, buttons))
                due = max(due + period, time.monotonic() - period)  # late ones are not made up for
                time.sleep(max(0.0, due - time.monotonic()))
        except Exception as error:
            self.Lose()
            self.failure = error

    def _stop(self):
        self._end.set()
        thread, self._thread = self._thread, None
        if thread and thread is not threading.current_thread():
            thread.join()
        if thread:
            self.disconnect()


def share(device: vtkSharedHapticDevice, memory: Any) -> np.ndarray:
    """Has a vtkSharedHapticDevice use a float64 array of 16 values, or a buffer of 128 bytes, which
    another process may share. Before Open(). Returns the array."""
    values = SharedHand(memory).values
    device.SetSharedArray(numpy_to_vtk(values))
    return values


def _on_state(device, _event):
    if device.GetState() == device.Opening:
        device._start()
        if device.failure:
            device.Close()
            raise device.failure
    elif device.GetState() in (device.Closed, device.Faulted):
        device._stop()


def _sample(sample):
    """A position and buttons, of what exchange() returned."""
    if isinstance(sample, tuple) and len(sample) == 2:
        position, buttons = sample
        buttons = int(buttons)
    else:
        position, buttons = sample, 0
    position = np.asarray(position, float)
    if position.shape != (3,):
        raise ValueError(
            f"exchange() returned a position of the shape {position.shape}; it must be (3,) [m]."
        )
    return position, buttons
