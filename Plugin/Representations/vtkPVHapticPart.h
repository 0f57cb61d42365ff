/**
 * @class   vtkPVHapticPart
 * @brief   A part of a vtkPVHapticScene that has a proxy of its own, below that of the scene
 *
 * The proxy of the scene shows the properties of its parts as its own. A part that no scene has
 * does nothing.
 *
 * GUI thread.
 *
 * @sa vtkPVHapticScene vtkPVHapticPicture vtkPVHapticReadings vtkPVHapticRecords
 * vtkPVHapticWorkspace
 */
#ifndef Haptics_vtkPVHapticPart_h
#define Haptics_vtkPVHapticPart_h

#include "vtkCommand.h"
#include "vtkHapticsRepresentationsModule.h"
#include "vtkObject.h"
#include "vtkWeakPointer.h"

#include <string>

namespace haptics
{
class RepresentedSurfaces;
}

class vtkHapticScene;

class VTKHAPTICSREPRESENTATIONS_EXPORT vtkPVHapticPart : public vtkObject
{
public:
  vtkAbstractTypeMacro(vtkPVHapticPart, vtkObject);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /// Invoked where a call has failed, after the error. Call data: const char*, what was wrong.
  enum PartEvents
  {
    FailEvent = vtkCommand::UserEvent + 4500
  };

#ifndef __VTK_WRAP__
  /** For vtkPVHapticScene, C++ only: what it is a part of; null when that is gone. */
  virtual void SetScene(vtkHapticScene* scene, haptics::RepresentedSurfaces* surfaces);
#endif

protected:
  vtkPVHapticPart();
  ~vtkPVHapticPart() override;

  /** Passes on what the scene has reported. */
  void Fail();
  /** Reports what is wrong. */
  void Fail(const std::string& message);

  vtkWeakPointer<vtkHapticScene> Scene;
  haptics::RepresentedSurfaces* Surfaces = nullptr; // as long as the scene is there

private:
  vtkPVHapticPart(const vtkPVHapticPart&) = delete;
  void operator=(const vtkPVHapticPart&) = delete;
};

#endif
