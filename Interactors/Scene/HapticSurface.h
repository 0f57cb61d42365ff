#ifndef Haptics_HapticSurface_h
#define Haptics_HapticSurface_h

#include "haptics/Scene/GeometryFollower.h"
#include "haptics/Scene/MaterialFollower.h"
#include "haptics/Scene/PoseFollower.h"
#include "haptics/Scene/PullSettings.h"
#include "haptics/Scene/SurfaceRay.h"
#include "haptics/Scene/SurfaceSource.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

class vtkBoundingBox;
class vtkGodObjectFilter;

namespace haptics
{
/// @brief One surface of a vtkHapticScene: where it comes from and the snapshot in force.
///
/// What its source shows is followed in three parts: the geometry, which becomes a snapshot; the
/// pose, which moves it; and the material. GUI thread.
class HapticSurface
{
public:
  using Snapshot = GeometryFollower::SnapshotPointer;
  using Properties = MaterialFollower::Properties;
  using CellIds = GeometryFollower::CellIds;

  HapticSurface(int id, std::unique_ptr<SurfaceSource> source);
  HapticSurface(const HapticSurface&) = delete;
  HapticSurface& operator=(const HapticSurface&) = delete;

  int Id() const { return this->Identifier; }
  /// TouchedSurface::Identity: another one once it was put elsewhere without pushing anything.
  std::uint64_t Identity() const
  {
    // 0 is nobody
    return static_cast<std::uint64_t>(this->Identifier) + 1 +
      (this->Geometry.NumberOfJumps() << 32);
  }
  /// What its user calls it; empty by default.
  std::string Name;
  /// How messages begin: "Surface 0", or "Surface 0 (its name)".
  std::string Title() const
  {
    return "Surface " + std::to_string(this->Identifier) +
      (this->Name.empty() ? "" : " (" + this->Name + ")");
  }
  /// The actor that was given; null for geometry and for the part of an assembly.
  vtkActor* Actor() const { return this->Source->Actor(); }
  /// Whether it follows an actor or the part of an assembly.
  bool Moves() const { return this->Source->Moves(); }
  /// Where it is now, from the geometry's frame to the world.
  Matrix4 Matrix() const { return this->Source->Matrix(); }
  vtkGodObjectFilter* Filter() const { return this->Geometry.Filter(); }

  /// Takes in what has changed since the last call. True where another snapshot is in force now
  /// than before, or another material, or the surface was shown or hidden. Where the new geometry
  /// is no good, `error` says why, once for each change, and the snapshot in force stays. It also
  /// says where one was faster than a hand can follow. Whole sentences.
  ///
  /// With a worker a changed geometry is built in the background; it comes into force at a call
  /// after that. What changes meanwhile is built next, in its newest state.
  bool Pull(const PullSettings& settings, std::string& error);

  /// See GeometryFollower.
  const BackgroundTask* Building() const { return this->Geometry.Building(); }
  void CancelBuild() { this->Geometry.CancelBuild(); }
  bool IsWaitingForServo() const { return this->Geometry.IsWaitingForServo(); }
  bool IsInPatches() const { return this->Geometry.IsInPatches(); }
  /// Where a ray first meets what can be touched from there; world frame.
  std::optional<RayHit> CastRay(const Vec3& from, const Vec3& direction);

  ///@{
  /// Whether the hand carries it; then it is not touched.
  void SetGripped(bool isGripped) { this->InGrip = isGripped; }
  bool IsGripped() const { return this->InGrip; }
  ///@}
  /// The hand has put it where it is: the next Pull() has it there at once, and it pushes nothing.
  void Carry() { this->IsCarried = true; }
  /// A point of the frame that Pose() moves, in that of the actor's geometry.
  Vec3 PointInActor(const Vec3& point) const { return this->Place.PointInGeometry(point); }

  /// Whether the last Pull() found it in another place.
  bool HasMoved() const { return this->Place.HasMoved(); }
  /// Where the snapshot's frame is in the world, as of the last Pull(). The servo gets there later,
  /// by the interval between two calls.
  const RigidPose& Pose() const { return this->Place.Pose(); }
  /// What the servo follows; null where the surface has no actor.
  std::shared_ptr<SurfaceMotion> Motion() const { return this->Place.Motion(); }

  /// What is touched; null while the surface is hidden or empty, or was never any good.
  Snapshot TouchableSurface() const
  {
    return this->IsThere() ? this->Geometry.Snapshot() : nullptr;
  }
  /// Its material; null while it is hidden, empty or plain.
  Properties TouchedProperties() const { return this->IsThere() ? this->Material.Get() : nullptr; }
  /// Whether what is touched is an older geometry, or in an older place, because the newest is no
  /// good.
  bool IsOutdated() const
  {
    return this->TouchableSurface() &&
      (this->Geometry.IsRefused() || this->Place.GetState() == PoseFollower::State::Refused);
  }
  /// Whether what was refused at a Pull() is refused still: geometry, matrix or an array.
  bool IsFaulty() const
  {
    return this->Geometry.IsRefused() || this->Place.GetState() == PoseFollower::State::Refused ||
      this->Filter()->HasBadArray();
  }
  /// Adds the world's bounds of what is touched, or while that is null of what is being built.
  void AddBounds(vtkBoundingBox& box) const;
  /// See GeometryFollower::Attributes().
  vtkPolyData* Prepared() const { return this->Geometry.Attributes(); }
  CellIds OriginalCellIds() const { return this->Geometry.OriginalCellIds(); }

private:
  void Follow(const PullSettings& settings, PullReport& report);
  bool IsThere() const { return this->IsShown && !this->Geometry.IsEmpty(); }

  int Identifier;
  std::unique_ptr<SurfaceSource> Source;
  PoseFollower Place;
  GeometryFollower Geometry;
  MaterialFollower Material;
  bool IsShown = true;
  bool InGrip = false;
  bool IsCarried = false;
};
}

#endif
