#ifndef Haptics_LandmarksSource_h
#define Haptics_LandmarksSource_h

class vtkPolyData;
class vtkSMProxy;

namespace haptics
{
/// @brief Makes a source of landmarks on the active server and shows it in the active view.
///
/// The source (a vtkHapticRecordSource) holds the points and their arrays itself: it is in state
/// files and traces, and undo takes it back. Returns it, or null without a server. GUI thread.
vtkSMProxy* MakeLandmarksSource(vtkPolyData* landmarks);
}

#endif
