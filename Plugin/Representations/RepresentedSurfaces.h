#ifndef Haptics_RepresentedSurfaces_h
#define Haptics_RepresentedSurfaces_h

#include "vtkActor.h"
#include "vtkBoundingBox.h"
#include "vtkGodObjectFilter.h"
#include "vtkSmartPointer.h"
#include "vtkWeakPointer.h"

#include <set>
#include <string>
#include <vector>

class vtkHapticScene;
class vtkHapticSurfaceRepresentation;

namespace haptics
{
/**
 * The representations of a view that are touched, kept up to date in a scene: which of a
 * representation's choices brings the triangles, its actor, name, side and material. Those that
 * are deleted are forgotten. GUI thread.
 */
class RepresentedSurfaces
{
public:
  /// The scene outlives this object.
  explicit RepresentedSurfaces(vtkHapticScene* scene)
    : Scene(scene)
  {
  }

  /// False where the object is no representation with a surface.
  bool Add(vtkObject* representation);
  void Clear() { this->Surfaces.clear(); }
  int Size() const { return static_cast<int>(this->Surfaces.size()); }
  /// The name of a representation's surface; null or the choice that brings its triangles while
  /// another one is drawn.
  void SetSource(
    vtkObject* representation, const std::string& name, vtkHapticSurfaceRepresentation* source);
  /// Whether they come from several processes, which may place the same point some units of the
  /// last place apart: such points are merged. Default false.
  void SetInPieces(bool inPieces) { this->InPieces = inPieces; }
  ///@{
  /// A vtkGodObjectFilter::Side, clamped. Default Automatic.
  void SetSide(int side);
  int GetSide() const { return this->Side; }
  ///@}

  /// Adds to the scene what can be touched now, and removes the rest.
  void Sync();

  ///@{
  /// As of the last Sync().
  int NumberOfTouchable() const;
  /// Whether one that is shown cannot be touched, or not as it is shown. One that is being built
  /// may be.
  bool HasBad() const;
  /// Whether any is shown that could be touched.
  bool IsAnyShown() const;
  /// Whether all come in patches, one of which is nearly always being built.
  bool AreInPatches() const;
  /// Of what is shown, which may still be in the background; not valid where nothing is.
  vtkBoundingBox Bounds() const;
  /// The point and cell arrays, except ParaView's own bookkeeping.
  std::set<std::string> NamesOfArrays() const;
  /// Which of them is the scene's surface with this id, in the order of Add(); else -1.
  int IndexOf(int id) const;
  const std::string& Name(int index) const { return this->Surfaces.at(index).Name; }
  ///@}

private:
  struct Surface
  {
    vtkWeakPointer<vtkObject> Representation;
    vtkWeakPointer<vtkHapticSurfaceRepresentation> Source; // while another choice is drawn
    vtkSmartPointer<vtkActor> Actor;                       // null while it cannot be touched
    int Id = -1;                                           // in the scene
    std::string Name;
  };
  static vtkHapticSurfaceRepresentation* SourceOf(const Surface& surface);

  vtkHapticScene* Scene;
  std::vector<Surface> Surfaces;
  bool InPieces = false;
  int Side = vtkGodObjectFilter::AUTOMATIC_SIDE;
};
}

#endif
