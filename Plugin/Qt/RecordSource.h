#ifndef Haptics_RecordSource_h
#define Haptics_RecordSource_h

class vtkPolyData;
class vtkSMProxy;

namespace haptics
{
///@{
/// @brief Makes a source of what the hand has left, on the active server, and shows it in the view.
///
/// The source (a vtkHapticRecordSource) holds the points and their arrays itself: it is in state
/// files and traces, and undo takes it back. What was selected stays so: it is what the user goes
/// on to touch. Returns the source, or null without a server. GUI thread.
vtkSMProxy* MakeLandmarksSource(vtkPolyData* landmarks);
/// Coloured by the array ForceMagnitude [N], where it has one.
vtkSMProxy* MakeTraceSource(vtkPolyData* trace);
/// As MakeTraceSource(), of vtkHapticRecordSource::MakeCurves().
vtkSMProxy* MakeCurvesSource(vtkPolyData* curves);
///@}

/// Opens a line chart of a source that MakeTraceSource() has made: ForceMagnitude [N] over Time
/// [s]. Other series can be chosen in its properties. The active view stays the active one. GUI
/// thread.
void PlotTrace(vtkSMProxy* trace);

/// Where a representation that has just been made is the line chart of a source that is a trace, as
/// Plot Data makes it, lets it begin with ForceMagnitude alone: ParaView begins with all series,
/// ids and newtons per metre among them. Any other representation stays as it is. GUI thread.
void BeginChartOfTrace(vtkSMProxy* representation);
}

#endif
