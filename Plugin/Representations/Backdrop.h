#ifndef Haptics_Backdrop_h
#define Haptics_Backdrop_h

#include "vtkSmartPointer.h"
#include "vtkWeakPointer.h"

#include <array>

class vtkMatrix4x4;
class vtkOpenGLFramebufferObject;
class vtkOpenGLRenderWindow;
class vtkRenderer;

namespace haptics
{
/**
 * What a window shows behind one of its renderers, colours and depths, kept from the last picture:
 * so that what this renderer shows can be drawn anew without the rest, however long that takes.
 *
 * The renderer neither clears nor is the lowest (vtkPVRenderView::GetNonCompositedRenderer()).
 * Where the window has several samples a pixel, or is stereoscopic, nothing is kept.
 *
 * GUI thread.
 */
class Backdrop
{
public:
  Backdrop();
  ~Backdrop();
  Backdrop(const Backdrop&) = delete;
  Backdrop& operator=(const Backdrop&) = delete;

  /// The renderer in front; null, the default, for none. Takes what its window shows now for what
  /// is behind.
  void SetRenderer(vtkRenderer* front);

  /// Draws what is in front anew. False, and nothing is done, where nothing is kept or the camera
  /// or the window's size is another one: then all has to be drawn.
  bool DrawFront();

private:
  using View = std::array<double, 16>;

  void OnStart();
  vtkOpenGLRenderWindow* Window() const;
  bool Copy(bool toWindow);
  void Keep();
  View Seen() const;

  vtkWeakPointer<vtkRenderer> Front;
  unsigned long Observer = 0;
  vtkSmartPointer<vtkOpenGLFramebufferObject> Picture; // of the window's context
  std::array<int, 2> Size{};
  View Camera{}; // that the picture was drawn with
  bool IsKept = false;
  bool Drawing = false; // what is in front, alone
};
}

#endif
