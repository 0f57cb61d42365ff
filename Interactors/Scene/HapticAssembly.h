#ifndef Haptics_HapticAssembly_h
#define Haptics_HapticAssembly_h

#include "vtkActor.h"
#include "vtkAssembly.h"
#include "vtkSmartPointer.h"

#include <vector>

class vtkProp;

namespace haptics
{
class PartSource;
class SurfaceSet;

/// @brief The actors in a vtkAssembly as surfaces of a scene, followed live. GUI thread.
///
/// An actor in an assembly does not know where it is: its place depends on the way down to it. So
/// each way from the top to an actor is a surface, with the matrix of the whole way; an actor that
/// hangs in two branches is two.
class HapticAssembly
{
public:
  HapticAssembly(int id, vtkAssembly* assembly);

  int Id() const { return this->Identifier; }
  vtkAssembly* Source() const { return this->Assembly; }

  /// Takes in parts that have come, gone or moved, or were shown or hidden.
  void Pull(SurfaceSet& surfaces);
  /// Takes all its parts away.
  void RemoveFrom(SurfaceSet& surfaces);
  /// Whether a part that can be touched is among them.
  bool IsTouchable(const SurfaceSet& surfaces) const;
  /// The actor that is the surface of this id; null where none is.
  vtkActor* FindActor(int surface) const;

private:
  struct Part
  {
    std::vector<vtkProp*> Way; ///< from the assembly to the actor
    vtkSmartPointer<vtkActor> Actor;
    PartSource* Source = nullptr; ///< of the surface, which owns it
    int Surface = -1;
    bool IsThere = false;
  };
  Part& FindOrAdd(const std::vector<vtkProp*>& way, vtkActor* actor, SurfaceSet& surfaces);

  int Identifier;
  vtkSmartPointer<vtkAssembly> Assembly;
  std::vector<Part> Parts;
};
}

#endif
