"""The installed plugin is there when ParaView starts, and touches. Argument: the prefix."""

import os
import sys

from paraview import servermanager, simple

PREFIX = os.path.realpath(sys.argv[1])

definitions = servermanager.ProxyManager().GetProxyDefinitionManager()
assert definitions.HasDefinition("haptics", "HapticScene"), "the plugin was not loaded"
assert definitions.HasDefinition("filters", "GodObjectTrace"), "the plugin has no filters"

import vtkhaptics
from vtkhaptics.paraview import touch

assert os.path.realpath(vtkhaptics.__file__).startswith(PREFIX), vtkhaptics.__file__
hand = touch(simple.Sphere(), Device="simulated")
hand.step(1500)
assert hand.ForceMagnitude > 0.1, hand.ForceMagnitude
with open("/proc/self/maps") as maps:
    ours = {line.split()[-1] for line in maps if "vtkHaptics" in line}
assert ours and all(os.path.realpath(file).startswith(PREFIX) for file in ours), ours
