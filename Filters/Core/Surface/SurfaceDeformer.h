#ifndef Haptics_SurfaceDeformer_h
#define Haptics_SurfaceDeformer_h

#include "haptics/Surface/TriangleSurface.h"
#include "vtkHapticsCoreModule.h"

#include <memory>
#include <string>
#include <vector>

namespace haptics
{
/// @brief Makes one snapshot after another of a surface whose points move and whose triangles stay.
///
///     GUI or worker thread:  points, duration ──Deform──> snapshot ──> new GodObject ──> servo
///                                                (from where the one before ends, to the points)
///
/// In the servo's hands the points of a snapshot are on their way for `duration`, from when it is
/// first touched, at the servo's rate; then they stay. The next snapshot starts there, so **each
/// has to be handed to the servo once the one before has been taken**; it waits its turn
/// (GodObject::HasArrived()). One that was left out is a surface that has changed all at once:
/// contact goes on from where it stood, but with a step.
///
/// An engine is refitted to where triangles pass, in a few milliseconds for 100,000 of them: a copy
/// of the given surface's at first, and one built anew where it has lost its order. Engines of
/// snapshots that nobody holds any more are used again, so two are made in all, or three where
/// those are deleted late.
///
/// One thread at a time.
class VTKHAPTICSCORE_EXPORT SurfaceDeformer
{
public:
  /// Goes on from a snapshot, not null. One built with EngineKind::Exact cannot be deformed.
  explicit SurfaceDeformer(std::shared_ptr<const TriangleSurface> surface);
  ~SurfaceDeformer();
  SurfaceDeformer(const SurfaceDeformer&) = delete;
  SurfaceDeformer& operator=(const SurfaceDeformer&) = delete;

  /// The next snapshot, whose points go to `points` (of the snapshot's own world frame, as many as
  /// it has) over `duration` [s], 0 to 1; sensibly the time to the next one. Null, with the cause
  /// in `error`, where that cannot be: then the latest snapshot stays.
  std::shared_ptr<const TriangleSurface> Deform(
    std::vector<Vec3> points, double duration, std::string& error);
  /// As Deform(), but the points have not moved there: the next snapshot is another surface that
  /// takes the place of the one before.
  std::shared_ptr<const TriangleSurface> Replace(std::vector<Vec3> points, std::string& error);
  /// The longest way of a point from what the next snapshot starts from to `points`, as in Deform()
  /// [world unit]. 0 where their numbers differ.
  double LongestWay(const std::vector<Vec3>& points) const;

  /// What the next snapshot will start from.
  const std::shared_ptr<const TriangleSurface>& Latest() const { return this->Current; }

  /// How many engines were built, the given one not counted. For tests and benchmarks.
  int NumberOfBuilds() const { return this->Builds; }

private:
  struct Engine;
  std::shared_ptr<const TriangleSurface> Make(
    std::vector<Vec3> points, double duration, bool follows, std::string& error);
  std::shared_ptr<Engine> Borrow();
  void CopyLatest(Engine& engine) const;
  bool Fit(Engine& engine, const TriangleSurface& next);

  std::shared_ptr<const TriangleSurface> Current;
  std::vector<std::shared_ptr<Engine>> Engines;
  std::shared_ptr<Engine> LatestEngine; ///< of Current; null as long as that is the given one
  int Builds = 0;
};
}

#endif
