#ifndef Haptics_GuiTestTools_h
#define Haptics_GuiTestTools_h

#include "pqCoreUtilities.h"

#include <QString>

#include <functional>

class QAction;
class pqPipelineSource;
class pqView;
class vtkPVHapticScene;
class vtkSMProxy;

/// What a user does and sees in ParaView with the plugin, for tests inside the running program.
namespace GuiTest
{
/// Lets ParaView go on until something is so. False where it is not after `seconds`.
bool waitUntil(const std::function<bool()>& isSo, double seconds = 10.0);

/// A widget of the main window by its name; null where there is none.
template <class T>
T* find(const char* name)
{
  return pqCoreUtilities::mainWidget()->findChild<T*>(name);
}

/// An action of the menu bar or a tool bar by its name; null where there is none.
QAction* findAction(const char* name);

/// Clicks the toolbar's button Touch, as a mouse does.
void pressTouch();
/// Whether that button is pressed in.
bool touchIsDown();

///@{
/// The scene that Touch has made, and what it drives; null before.
vtkSMProxy* scene();
vtkPVHapticScene* clientScene();
///@}

/// The text of the plugin's message box, which is closed then; empty where there is none.
QString takeComplaint();

///@{
/// A source, a filter, a file: made, applied, shown in the active view and selected.
pqPipelineSource* makeSource(const char* name);
pqPipelineSource* makeFilter(const char* name, pqPipelineSource* input);
pqPipelineSource* openFile(const QString& file);
///@}
/// Applies what was set, and shows it in the active view.
void apply(pqPipelineSource* source);
/// The contour of the Wavelet source at 157, seen from the front.
pqPipelineSource* makeWaveletContour();

/// Moves the cursor to a place in the active view, 0 to 1 from its lower left corner.
void moveMouse(double x, double y);
/// Turns the wheel there, forwards for more than 0 notches.
void turnWheel(double x, double y, int notches);

/// The representation of the active source, as the toolbar names it.
QString representationType();
/// Whether that can be touched.
bool isTouchable();
bool engaged();
bool touching();
/// Waits until the surfaces are built; then the wheel takes the hand to the surface at that height
/// in the middle of the view, and a little into it. By default where the contour has no hole.
bool press(double height = 0.4);
/// The device, as the proxy names it.
void setDevice(const char* name);

/// Releases the hand, deletes all sources and views, and makes a render view of 400 x 400 pixels.
void startAnew();
}

#endif
