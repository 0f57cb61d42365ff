"""Touches a contour as ParaView shows it, marks where it was pressed, and shows where the hand went.

Run it with pvpython, or in ParaView's Python shell; with Connect() before, the data may be on a
server. Without a display it touches all the same, and says that it draws nothing.
"""

from paraview.simple import Contour, Render, Show, Wavelet

from vtkhaptics.display import needs_display
from vtkhaptics.paraview import touch

contour = Contour(Input=Wavelet(), ContourBy=["POINTS", "RTData"], Isosurfaces=[157.0])
hand = touch(contour, Device="simulated", Stiffness=300.0)
hand.RecordTrace = 1
for _ in range(10):
    hand.step(300)  # virtual time: every run gives the same
    if hand.Touching:
        hand.drop_landmark()

trace, landmarks = hand.trace_source(), hand.landmark_source()
for source in (trace, landmarks):
    Show(source, hand.View)
if needs_display():
    print("No picture is drawn: DISPLAY is not set, and this ParaView needs an X server (or xvfb-run).")
else:
    Render(hand.View)

assert hand.NumberOfLandmarks > 0
values = dict(zip(hand.ProbedValues[::2], hand.ProbedValues[1::2]))
print(f"{hand.NumberOfLandmarks} landmarks; now {hand.ForceMagnitude:.2f} N, {values}")
