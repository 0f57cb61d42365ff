#ifndef Haptics_SurfaceSet_h
#define Haptics_SurfaceSet_h

#include "haptics/Contact/TouchedSurface.h"
#include "haptics/Scene/HapticAssembly.h"
#include "haptics/Scene/HapticSurface.h"
#include "haptics/Scene/SurfaceRay.h"
#include "haptics/Scene/TouchedPlace.h"
#include "haptics/Tick/TickRecord.h"

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

class vtkHapticProbe;

namespace haptics
{
/// A cell of a surface of the scene, as its user knows them.
struct SceneCell
{
  int Surface = -1;    ///< id
  vtkIdType Cell = -1; ///< of the geometry as it was given
};

/// @brief The surfaces of a scene, and what the servo's indices mean. GUI thread.
///
/// Of an assembly every part is a surface; the assembly itself has an id too, to remove it.
///
/// A god-object numbers its surfaces from 0; ids stay when others come and go. What was published
/// is remembered until no tick can refer to it any more.
class SurfaceSet
{
public:
  /// Adds one and returns its id.
  int Add(std::unique_ptr<SurfaceSource> source)
  {
    this->Surfaces.push_back(std::make_unique<HapticSurface>(this->NextId, std::move(source)));
    return this->NextId++;
  }
  /// Adds an assembly, whose parts come with Pull(); the id that it has where it is known.
  int Add(vtkAssembly* assembly);
  /// Removes a surface or a whole assembly; false for a part of one, which would come back.
  bool Remove(int id);
  /// Removes a surface that is the part of an assembly and has gone from it.
  void RemovePart(int id);
  void Clear();

  const std::vector<std::unique_ptr<HapticSurface>>& All() const { return this->Surfaces; }
  HapticSurface* Find(int id) const;
  HapticSurface* Find(vtkActor* actor) const;
  /// The id of an assembly; -1 where it is not among them.
  int FindAssembly(vtkAssembly* assembly) const;
  /// The assembly that a surface is a part of, or that has this id; null elsewhere.
  vtkAssembly* AssemblyOf(int id) const;
  /// The actor that a user sees as a surface, alone or in an assembly; null where there is none.
  vtkActor* ActorOf(int id) const;
  /// Whether a surface, or a part of an assembly, can be touched now.
  bool IsTouchable(int id) const;
  /// HapticSurface::Title() of an id, whether there still is one or not.
  std::string Title(int id) const;

  /// Grips a surface or lets go of it, from the next publication on.
  void SetGripped(int id, bool isGripped);

  /// Takes in parts of assemblies that have come, gone or moved.
  void PullAssemblies();
  /// Takes in what has changed, after PullAssemblies(). True where a new god-object has to be
  /// published. Each new error is appended to `errors`, naming its surface.
  bool Pull(const PullSettings& settings, std::vector<std::string>& errors);
  /// Whether something that was refused at a Pull() is refused still.
  bool IsFaulty() const;

  /// Whether a surface that can be touched was in another place at the last Pull().
  bool HaveMoved() const;
  /// Whether a surface has changed before the servo has come to its last change.
  bool IsWaiting() const;
  /// Whether a surface comes in patches, which follow the hand.
  bool IsInPatches() const;
  /// Whether a surface is being built in the background.
  bool IsBuilding() const;
  /// 0 to 1, over all that is being built or was since nothing was; 1 where nothing is.
  double BuildProgress() const;
  void CancelBuilds();

  /// What a god-object is to touch now.
  std::vector<TouchedSurface> TouchableSurfaces() const;
  /// Where a ray first meets what is touched, in lengths of `direction`; world frame.
  std::optional<RayHit> CastRay(const Vec3& from, const Vec3& direction) const;
  /// Remembers what TouchableSurfaces() gave under the number it was published with.
  void OnPublished(std::uint64_t generation);
  /// Forgets what was published before `generation`.
  void Forget(std::uint64_t generation);
  /// Forgets what was published before or after `generation`.
  void ForgetAllBut(std::uint64_t generation);

  /// What the first constraint of a tick belongs to.
  SceneCell Locate(const TickRecord& tick) const;
  /// The same for a trace.
  TouchedPlace Trace(const TickRecord& tick) const;
  /// Where the god-object was in a tick, in the frame that a surface's Pose() moves: exactly where
  /// it held the god-object, else as it is now.
  Vec3 PointOf(const TickRecord& tick, const HapticSurface& surface) const;
  /// Fills a new probe with what a tick touched.
  void Probe(const TickRecord& tick, vtkHapticProbe* probe) const;
  /// The corners of the triangles that hold the god-object in a tick, three each; world frame,
  /// where their surfaces are shown now.
  std::vector<Vec3> ActiveCorners(const TickRecord& tick) const;

private:
  struct Entry
  {
    int Id;
    HapticSurface::CellIds Cells;
    HapticSurface::Snapshot Surface;
    vtkSmartPointer<vtkPolyData> Prepared; ///< Surface's triangles, with the arrays of then
    bool HasExchangedCorners;              ///< Surface's, against Prepared's
  };
  vtkPolyData* PreparedOf(const Entry& entry) const;
  const Entry* Find(const TickRecord& tick, int constraint) const;
  /// Those that a god-object has, in its order: what is gripped comes last.
  std::vector<const HapticSurface*> Listed() const;

  std::vector<std::unique_ptr<HapticSurface>> Surfaces;
  std::vector<HapticAssembly> Assemblies; // whose parts are among the surfaces
  std::map<std::uint64_t, std::vector<Entry>> Generations;
  int NextId = 0;
  bool Changed = true;   // nothing was published yet
  int BuildsStarted = 0; // since nothing was being built
};
}

#endif
