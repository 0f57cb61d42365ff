"""vtkhaptics.touch() opens a real window on arrays, which a person touches and closes.

Real keys, a real mouse, a real window manager.
"""

import sys

from real_window import Desktop, skip_where_it_cannot_run

PROGRAM = """
import numpy as np
import vtkhaptics

# A step down, and a table that is concave, which VTK would draw as a fan: its cell is still one.
corners = np.array([(-1, -1), (0.5, 0), (1, -1), (1, 1), (-1, 1)]) * 0.05
below = [(-0.01, -0.01, -0.02), (0.01, -0.01, -0.02), (0, 0.01, -0.02)]
vertices = np.vstack([below, np.column_stack([corners, np.zeros(5)])])
table = (vertices, [[0, 1, 2], [3, 4, 5, 6, 7]])
print("ready", flush=True)
t = vtkhaptics.touch(table, size=(400, 300))
assert set(t["OriginalCellId"][t.touching]) == {1}, "the cell of the array that was given"
print(f"{len(t)} ticks, {t.touching.sum()} touching, up to {t.magnitude.max():.2f} N", flush=True)
"""


def test_touch():
    with Desktop() as desktop:
        program = desktop.start([sys.executable, "-c", PROGRAM])
        program.says("ready")
        program.focus()
        for _ in range(8):
            program.move(0.5, 0.5)
            desktop.xdo("click", 4)  # a notch of the wheel
        desktop.xdo("keydown", "space")
        program.drag(0.6, 0.55, seconds=1.0)
        desktop.xdo("keyup", "space")
        program.key("q")
        assert program.ended(30.0) == 0, program.output()
        words = program.output().splitlines()[-1].split()
        ticks, touching, force = int(words[0]), int(words[2]), float(words[6])
        assert ticks > 100 and touching > 50 and force > 0.05, program.output()
        print(program.output().splitlines()[-1])


skip_where_it_cannot_run()
test_touch()
