"""Writes touched.pvsm and stroke.haptic into the current folder, for a release to keep.

Run by pvpython, with the environment of env.sh: pvpython make_state.py
"""

import os

from paraview import simple

import vtkhaptics.paraview as haptics

haptics.load_plugin()
view = simple.CreateView("RenderView")
view.ViewSize = [300, 200]
sphere = simple.Sphere(ThetaResolution=32, PhiResolution=32)
hand = haptics.scene()
hand.set(View=view, Device="simulated", Stiffness=321.0, MaximumForce=2.0, Side="Both")
hand.touch(sphere, view)
view.CameraPosition = [1.0, 0.7, 2.0]
simple.Render(view)
hand.RecordingFileName = os.path.abspath("stroke.haptic")
hand.step(500)
hand.RecordingFileName = ""
simple.SaveState(os.path.abspath("touched.pvsm"))
