#ifndef Haptics_PythonStates_h
#define Haptics_PythonStates_h

#include "vtkHapticsRepresentationsModule.h"

namespace haptics
{
/**
 * Lets ParaView's Python find the package vtkhaptics that came with this library, where none is in
 * its path, and lets Python states (File > Save State) have the scene, which ParaView asks no
 * plugin for. Costs nothing before the first such state: Python is not started, and nothing is
 * imported. Does nothing the second time, and in a ParaView without Python. GUI thread.
 */
VTKHAPTICSREPRESENTATIONS_EXPORT void ExtendPython();
}

#endif
