"""The device's end of the memory that a vtkSharedHapticDevice shares with what drives a device.

Needs NumPy alone, so that it can be copied to where VTK is not. The layout is that of
haptics::SharedValue (Devices/Shared/SharedExchange.h), and does not change.
"""

import time
from typing import Any

import numpy as np

HAND_SEQUENCE, HAND_POSITION, HAND_BUTTONS, HAND_LOST = 0, slice(1, 4), 4, 5
FORCE_SEQUENCE, FORCE, FORCE_LIVE, SIZE = 8, slice(9, 12), 12, 16

STALE = 0.02  # [s]: a force that nobody has renewed for so long is withdrawn


class SharedHand:
    """The device's end of the memory that a vtkSharedHapticDevice shares.

    `memory` is a float64 array of 16 values, or a buffer of 128 bytes (the `buf` of a
    multiprocessing.shared_memory.SharedMemory, an mmap). For one thread.
    """

    def __init__(self, memory: Any) -> None:
        if not isinstance(memory, np.ndarray):
            memory = np.frombuffer(memory, np.float64, SIZE)
        if memory.dtype != np.float64 or memory.shape != (SIZE,) or not memory.flags.c_contiguous:
            raise ValueError(
                f"the shared memory is {memory.shape} of {memory.dtype}; it must be {SIZE} "
                "contiguous float64."
            )
        self.values = memory
        self._sequence = -1.0
        self._renewed = time.monotonic()

    def exchange(self, position: Any, buttons: int = 0) -> np.ndarray:
        """Reports the position of the hand [m], device frame, and the buttons that it holds (bit i is button
        i); returns the force to give it [N], a new (3,) array. Zero where no servo renews it."""
        values = self.values
        sequence = values[HAND_SEQUENCE]
        if not sequence % 2 == 0:  # whoever wrote here before has ended in between, or it is NaN
            sequence = 0.0
        values[HAND_SEQUENCE] = sequence + 1
        values[HAND_POSITION] = position
        values[HAND_BUTTONS] = buttons
        values[HAND_LOST] = 0
        values[HAND_SEQUENCE] = sequence + 2
        return self.force()

    def lose(self) -> None:
        """Reports that the device is lost: the servo ends with zero force at its next tick."""
        self.values[HAND_LOST] = 1

    def force(self) -> np.ndarray:
        """The force [N], a new (3,) array; zero where no servo has renewed it for 20 ms."""
        values = self.values
        for _ in range(4):
            sequence = values[FORCE_SEQUENCE]
            force = values[FORCE].copy()
            if sequence % 2 == 0 and values[FORCE_SEQUENCE] == sequence:
                break
        else:
            return np.zeros(3)  # just being written, again and again
        now = time.monotonic()
        if sequence != self._sequence:
            self._sequence, self._renewed = sequence, now
        if values[FORCE_LIVE] != 1.0 or now - self._renewed > STALE or not np.isfinite(force).all():
            return np.zeros(3)
        return force
