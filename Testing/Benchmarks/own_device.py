"""How regular a haptic device in Python is: what a thread and a process of its own can hold.

usage: own_device.py [SECONDS]

Prints, for a device whose exchange() only takes the time, the rate and the quantiles of the time
between two exchanges, while the main thread sleeps, and while it computes in Python all the time.
"""

import os
import subprocess
import sys
import tempfile
import time

import numpy as np
import vtkhaptics

SECONDS = float(sys.argv[1]) if len(sys.argv) > 1 else 10.0
DRIVER = """
import sys, time, importlib.util
import numpy as np
spec = importlib.util.spec_from_file_location("sharing", sys.argv[1])
sharing = importlib.util.module_from_spec(spec)
spec.loader.exec_module(sharing)
hand = sharing.SharedHand(np.memmap(sys.argv[2], np.float64, "r+", shape=16))
times, due = [], time.monotonic()
end = due + float(sys.argv[3])
while due < end:
    times.append(time.perf_counter())
    hand.exchange((0.0, 0.0, 0.01))
    due = max(due + 0.001, time.monotonic() - 0.001)
    time.sleep(max(0.0, due - time.monotonic()))
np.save(sys.argv[4], times)
"""


class Device(vtkhaptics.HapticDevice):
    """Keeps the time of each exchange."""

    def __init__(self):
        super().__init__()
        self.SetTimeout(60.0)
        self.times = []

    def exchange(self, force):
        self.times.append(time.perf_counter())
        return 0.0, 0.0, 0.01


def spend(seconds, busy):
    """Sleeps, or computes in Python."""
    end = time.monotonic() + seconds
    while busy and time.monotonic() < end:
        sum(range(1000))
    time.sleep(max(0.0, end - time.monotonic()))


def show(name, times):
    gaps = 1e3 * np.diff(times)
    cells = " ".join(f"{value:8.2f}" for value in (*np.quantile(gaps, (0.5, 0.99, 0.999)), gaps.max()))
    print(f"{name:44} {1e3 / gaps.mean():7.0f} {cells} {np.mean(gaps > 20.0):9.2%}", flush=True)


print(f"{'':44} {'Hz':>7} {'p50 ms':>8} {'p99':>8} {'p99.9':>8} {'max':>8} {'over 20':>9}")
for busy in (False, True):
    for interval in (0.005, 0.0005):
        sys.setswitchinterval(interval)
        device = Device()
        device.Open()
        spend(SECONDS, busy)
        device.Close()
        name = f"thread, {'busy' if busy else 'idle'} main thread, {1e3 * interval:g} ms switches"
        show(name, device.times)
    with tempfile.TemporaryDirectory() as folder:
        memory, times = os.path.join(folder, "hand"), os.path.join(folder, "times.npy")
        np.zeros(16).tofile(memory)
        sharing = os.path.join(os.path.dirname(vtkhaptics.__file__), "sharing.py")
        driver = subprocess.Popen([sys.executable, "-c", DRIVER, sharing, memory, str(SECONDS), times])
        spend(SECONDS, busy)
        driver.wait()
        show(f"process of its own, {'busy' if busy else 'idle'} main thread", np.load(times))
