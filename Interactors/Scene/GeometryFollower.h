#ifndef Haptics_GeometryFollower_h
#define Haptics_GeometryFollower_h

#include "haptics/Scene/JumpNotice.h"
#include "haptics/Scene/PatchPlanner.h"
#include "haptics/Scene/PoseFollower.h"
#include "haptics/Scene/PullSettings.h"
#include "haptics/Scene/SurfaceBuild.h"
#include "haptics/Scene/SurfaceRay.h"
#include "haptics/Scene/SurfaceSource.h"
#include "haptics/Surface/SurfaceDeformer.h"
#include "haptics/Surface/TriangleSurface.h"
#include "vtkCallbackCommand.h"
#include "vtkGodObjectFilter.h"
#include "vtkIdTypeArray.h"
#include "vtkNew.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkType.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

class vtkAlgorithmOutput;
class vtkBoundingBox;
class vtkHapticPatchAlgorithm;

namespace haptics
{
/// @brief How a surface follows the geometry of its source: from what is connected to a snapshot.
///
/// The geometry is prepared as a vtkGodObjectFilter of its own says. One that has the cells of the
/// one before, with points elsewhere, deforms over the time between two changes; any other becomes
/// a snapshot that takes the place of the last. GUI thread.
class GeometryFollower
{
public:
  using SnapshotPointer = std::shared_ptr<const TriangleSurface>;
  using CellIds = std::shared_ptr<const std::vector<vtkIdType>>;

  /// Both outlive it.
  GeometryFollower(SurfaceSource& source, PoseFollower& pose);
  /// Asks for the end of a build, and does not wait for it.
  ~GeometryFollower();
  GeometryFollower(const GeometryFollower&) = delete;
  GeometryFollower& operator=(const GeometryFollower&) = delete;

  vtkGodObjectFilter* Filter() const { return this->Preparation; }
  /// What the filter has reported since the last call. Whole sentences.
  std::string TakeFilterError();

  /// Takes over what has been built in the background, unless it has to wait for the servo: one
  /// that goes on from a snapshot has to come after it.
  void TakeDoneBuild(const PullSettings& settings, PullReport& report);
  /// Connects what the source has now; false where it has none, which is an error once.
  bool Connect(PullReport& report);
  /// Builds what has changed, or begins to. `hasMoved`: whether the pose follower's matrix is
  /// another one than before. `wasUnseen`: nothing was touched before this Pull().
  void Follow(bool hasMoved, bool wasUnseen, const PullSettings& settings, PullReport& report);

  /// The build in the background; null while there is none, or a done one waits for IsTaken.
  const BackgroundTask* Building() const
  {
    return this->Stage == BuildStage::Builds ? this->Build.get() : nullptr;
  }
  /// Gives up the build: what is in force stays until the geometry changes again.
  void CancelBuild();
  /// Whether it has changed and waits for IsTaken.
  bool IsWaitingForServo() const
  {
    return this->IsChangeWaiting || this->Stage == BuildStage::WaitsForServo;
  }

  /// What is in force; null where the geometry was never any good.
  const SnapshotPointer& Snapshot() const { return this->InForce; }
  /// How often it was put elsewhere without pushing anything.
  std::uint64_t NumberOfJumps() const { return this->Jumps; }
  /// Whether the newest geometry has no cells.
  bool IsEmpty() const { return this->HasNoCells; }
  /// Whether the newest geometry is no good, so that an older one is in force.
  bool IsRefused() const { return this->HasRefused || !this->ConnectError.empty(); }
  /// The geometry in force, its triangles in the snapshot's order, with its arrays as they were at
  /// the last Follow(). Null where it was never any good.
  vtkPolyData* Attributes() const { return this->InForceData; }
  /// For each triangle of the snapshot in force the id of its cell in the geometry given.
  const CellIds& OriginalCellIds() const { return this->Ids; }
  /// Adds the world's bounds of what is being built for the first time, if anything is.
  void AddBoundsOfBuild(vtkBoundingBox& box) const;
  /// Adds the world's bounds of a surface that comes in patches; false where it does not.
  bool AddBoundsOfPatches(vtkBoundingBox& box) const;
  /// Whether it comes in patches, which follow the hand.
  bool IsInPatches() const { return this->Planner.has_value(); }
  /// Where a ray meets a surface that comes in patches, also beyond the one in force; world frame.
  std::optional<RayHit> CastRayThroughPatches(const Vec3& from, const Vec3& direction);

private:
  enum class BuildStage
  {
    Rests,        ///< nothing is being built
    Builds,       ///< in the background, or done since the last look
    WaitsForServo ///< done
  };
  /// Everything that a geometry depends on, to see whether it has changed.
  struct Version
  {
    vtkAlgorithmOutput* Geometry = nullptr;
    vtkMTimeType Pipeline = 0;

    bool operator==(const Version& other) const
    {
      return this->Geometry == other.Geometry && this->Pipeline == other.Pipeline;
    }
  };

  void ForgetAsked();
  Vec3 PointInGeometry(const Vec3& point) const;
  bool Look(const PatchRegion& beam);
  void FollowHand(const PullSettings& settings, PullReport& report);
  void Ask(const PatchRequest& request);
  Version Look(const PullSettings& settings);
  vtkPolyData* UpdateGeometry(PullReport& report);
  void Prepare(bool wasUnseen, const PullSettings& settings, PullReport& report);
  void StartBuild(const std::shared_ptr<SurfacePreparation>& preparation, bool wasUnseen,
    const PullSettings& settings, PullReport& report);
  void DeformWhatIsInForce(const PullSettings& settings);
  void TakeBuild(const PullSettings& settings, PullReport& report);
  void KeepAttributes(vtkPolyData* geometry);
  void KeepCellIds();

  SurfaceSource& Source;
  PoseFollower& Pose;
  vtkNew<vtkGodObjectFilter> Preparation;
  vtkNew<vtkCallbackCommand> Listener;
  std::string FilterError;
  std::string ConnectError;

  vtkHapticPatchAlgorithm* Patches = nullptr; ///< what is connected, if that gives patches
  std::optional<PatchPlanner> Planner;        ///< once the whole surface is known
  std::optional<PatchRequest> Fetching;       ///< in the background, and not at hand yet
  std::optional<PatchRequest> Asked;          ///< of the patches, and not in force yet
  vtkMTimeType SurveyTried = 0;               ///< of the patches
  /// What is around the last ray that was cast, for those near it.
  struct Beam
  {
    std::uint64_t Version = 0; ///< of the surface
    PatchRegion Region;
    std::shared_ptr<const TriangleSurface> Surface; ///< null: nothing is there
  };
  std::optional<Beam> LastBeam;

  bool IsTried = false; ///< a first geometry
  Version LastTried;
  Version LastSeen;
  ///@{
  /// Of patches: vtkHapticPatchAlgorithm::GetVersion(), when it was seen, and planned for.
  vtkTypeUInt64 SeenSurface = 0;
  vtkTypeUInt64 PlannedSurface = 0;
  ///@}
  double SeenAt = 0.0;          ///< the servo's time [s]
  double SeenInterval = 0.0;    ///< PullSettings::Interval, then
  bool HasRested = false;       ///< before it was seen
  bool IsChangeWaiting = false; ///< for the servo
  bool HasNoCells = false;
  bool HasRefused = false;
  bool IsRefusedForMatrix = false; ///< it may be tried again with another matrix

  BuildStage Stage = BuildStage::Rests;
  std::shared_ptr<SurfaceBuild> Build;        ///< null while it rests
  double BuildSeenAt = 0.0;                   ///< when what is being built was seen
  vtkSmartPointer<vtkPolyData> BuildInput;    ///< with the arrays as they were when it started
  vtkSmartPointer<vtkIdTypeArray> BuildCells; ///< SurfaceSource::Cells(), likewise

  SnapshotPointer InForce;
  std::shared_ptr<SurfacePreparation> Base;  ///< what InForce was made of
  std::shared_ptr<SurfaceDeformer> Deformer; ///< what made InForce; null where it was built
  double LastChanged = 0.0;                  ///< when InForce was first seen, servo's time [s]
  std::uint64_t Jumps = 0;
  JumpNotice Leap;
  CellIds Ids;
  vtkSmartPointer<vtkIdTypeArray> IdsThrough; ///< SurfaceSource::Cells() that Ids are of
  vtkSmartPointer<vtkPolyData> InForceData;
};
}

#endif
