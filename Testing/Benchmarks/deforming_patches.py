"""Measures how the force changes in a tick on a surface that an animation deforms, in patches and whole.

usage: pvpython --force-offscreen-rendering deforming_patches.py [--speeds 0.01,0.03,0.07,0.2]
           [--ranks 0] [--plugin FILE]

A hand goes round on a ball 0.1 m across, 5 mm deep (2 N), that breathes: one time step every 33 ms, its
surface no faster than each speed in the hand [m/s]. Virtual time, so the load of the machine does not
count. One line of CSV for each speed and way of delivery, with --ranks over a pvserver of so many.
Largest change of the force in a tick and the largest fall of it, from 0.15 s on, and how far the forces
are from those of whole delivery: root mean square, and the most.
"""

import argparse
import csv
import os
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
SOFT_START = 150  # ticks
COLUMNS = ("ranks", "speed [m/s]", "delivery", "ticks touching", "largest change [N]", "largest fall [N]",
           "rms difference [N]", "largest difference [N]", "builds")


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--speeds", default="0.01,0.03,0.07,0.2")
    parser.add_argument("--ranks", type=int, default=0)
    parser.add_argument("--plugin", default=os.path.join(
        os.environ.get("PV_PLUGIN_PATH", "").split(os.pathsep)[0], "Haptics.so"))
    options = parser.parse_args()
    sys.path.insert(0, os.path.join(os.path.dirname(HERE), "ParaView"))
    sys.argv[1:] = [options.plugin, sys.executable]

    import numpy as np
    import HapticChanges as changes
    from HapticServerTesting import Server

    def breathing(speed):
        """A ball that goes no faster, and the animation of it."""
        amplitude = speed * changes.SCALE / (0.9 / (0.001 * changes.FRAME))
        ball = changes.changes()["deforming_played"]
        script = changes.BREATHING_POINTS.replace("0.5 *", f"{amplitude} *")
        assert script != changes.BREATHING_POINTS

        def pipeline():
            sphere = changes.simple.Sphere(Radius=1.0, ThetaResolution=64, PhiResolution=64)
            return [changes.timed(sphere, script), sphere]

        ball.pipeline = pipeline
        return ball

    out = csv.writer(sys.stdout)
    out.writerow(COLUMNS)
    server = Server(options.ranks) if options.ranks else None
    try:
        for speed in [float(text) for text in options.speeds.split(",")]:
            whole = None
            for delivery in ("whole", "patches"):
                ticks = changes.follow(breathing(speed), in_patches=delivery == "patches")
                force = ticks.arrays["Force"][SOFT_START:]
                strength = np.linalg.norm(force, axis=1)
                whole = force if delivery == "whole" else whole
                difference = np.linalg.norm(force - whole, axis=1)
                out.writerow([options.ranks, speed, delivery, int(ticks.touching.sum()),
                              *(f"{value:.3g}" for value in (
                                  np.linalg.norm(np.diff(force, axis=0), axis=1).max(),
                                  -np.diff(strength).min(),
                                  np.sqrt((difference ** 2).mean()), difference.max())),
                              ticks.builds])
                for complaint in ticks.complaints:
                    print(complaint, file=sys.stderr)
                sys.stdout.flush()
    finally:
        if server:
            changes.simple.Disconnect()
            server.stop()


if __name__ == "__main__":
    main()
