#ifndef Haptics_HapticSurface_h
#define Haptics_HapticSurface_h

#include "haptics/Material/SurfaceProperties.h"
#include "haptics/Scene/SurfaceBuild.h"
#include "haptics/Scene/SurfaceSource.h"
#include "haptics/Surface/SurfaceMotion.h"
#include "haptics/Surface/TriangleSurface.h"
#include "vtkCallbackCommand.h"
#include "vtkIdTypeArray.h"
#include "vtkNew.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkType.h"

#include <algorithm>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

class vtkAlgorithmOutput;
class vtkBoundingBox;
class vtkGodObjectFilter;
class vtkObject;

namespace haptics
{
/// How the surfaces of a scene take in what has changed.
struct PullSettings
{
  /// Builds beside the GUI thread; null: each Pull() builds what it needs.
  BackgroundWorker* Worker = nullptr;
  /// Whether a servo ticks; where not, what moves is in its new place at once.
  bool IsLive = false;
  /// Whether it does so in real time, and not only while somebody steps it.
  bool IsRunning = false;
  /// Whether it has what was told last; else a snapshot that it has not seen must not be deformed.
  bool IsTaken = false;
  double Now = 0.0;      ///< the servo's time [s]
  double Interval = 0.0; ///< since the Pull() before [s]
  double Scale = 1.0;    ///< of the workspace [world unit / m in the hand]

  /// Of a surface that pushes a hand, in the hand [m/s].
  static constexpr double LargestSpeed = 5.0;
  /// How long a motion takes: while one comes with each update, or with every other one, the time
  /// from one to the next. A surface whose next update comes later than LongestMotion has rested
  /// before it.
  double DurationSince(double last) const
  {
    const double since = this->Now - last;
    const double duration = since > 0.0 && since <= LongestMotion ? since : this->Interval;
    return std::clamp(duration, 0.0, LongestMotion);
  }
};

/// @brief One surface of a vtkHapticScene: where it comes from and the snapshot in force.
///
/// The geometry is prepared as a vtkGodObjectFilter of its own says. The actor's matrix is split:
///
///     matrix = Pose() * baked
///
/// A geometry that has the cells of the one before, with points elsewhere, deforms over the time
/// between two changes; any other becomes a snapshot that takes the place of the last.
///
/// The pose is rigid and goes to the servo as it is, so an actor that is dragged costs nothing
/// but that. Scale, shear and mirror are baked into the snapshot's points: where they change a new
/// engine is built, without a second clean-up. GUI thread.
class HapticSurface
{
public:
  using Snapshot = std::shared_ptr<const TriangleSurface>;
  using Properties = std::shared_ptr<const SurfaceProperties>;
  using CellIds = std::shared_ptr<const std::vector<vtkIdType>>;

  HapticSurface(int id, std::unique_ptr<SurfaceSource> source);
  /// Asks for the end of a build, and does not wait for it.
  ~HapticSurface();
  HapticSurface(const HapticSurface&) = delete;
  HapticSurface& operator=(const HapticSurface&) = delete;

  int Id() const { return this->Identifier; }
  /// TouchedSurface::Identity: another one once it was put elsewhere without pushing anything.
  std::uint64_t Identity() const
  {
    return static_cast<std::uint64_t>(this->Identifier) + 1 + (this->Jumps << 32); // 0 is nobody
  }
  /// What people call it; empty where nobody has given it a name.
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
  vtkGodObjectFilter* Filter() const { return this->Preparation; }

  /// Takes in what has changed since the last call. True where another snapshot is in force now
  /// than before, or other properties, or the surface was shown or hidden. Where the new geometry
  /// is no good, `error` tells why, once for each change, and the snapshot in force stays. It also
  /// tells where one was faster than a hand can follow. Whole sentences.
  ///
  /// With a worker a changed geometry is built beside; it comes into force at a call after that.
  /// What changes meanwhile is built next, in its newest state.
  bool Pull(const PullSettings& settings, std::string& error);

  /// The build beside the GUI thread; null while there is none, or a done one waits for IsTaken.
  const BackgroundTask* Building() const { return this->IsPostponed ? nullptr : this->Build.get(); }
  /// Gives up the build: what is in force stays until the geometry changes again.
  void CancelBuild();

  ///@{
  /// Whether the hand carries it; then it is not felt.
  void SetGripped(bool isGripped) { this->Gripped = isGripped; }
  bool IsGripped() const { return this->Gripped; }
  ///@}
  /// The hand has put it where it is: the next Pull() has it there at once, and it pushes nothing.
  void Carry() { this->Carried = true; }
  /// A point of the frame that Pose() moves, in that of the actor's geometry.
  Vec3 PointInActor(const Vec3& point) const;
  /// Whether it has changed and waits for IsTaken.
  bool IsWaitingForServo() const { return this->IsWaiting || this->IsPostponed; }

  /// Whether the last Pull() found it in another place.
  bool HasMoved() const { return this->IsElsewhere; }
  /// Where the snapshot's frame is in the world, as of the last Pull(). The servo gets there later,
  /// by the interval between two calls.
  const RigidPose& Pose() const { return this->Placed; }
  /// What the servo follows; null where the surface has no actor.
  std::shared_ptr<SurfaceMotion> Motion() const { return this->Moving; }

  /// What is touched; null while the surface is hidden or empty, or was never any good.
  Snapshot Touched() const { return this->IsThere() ? this->InForce : nullptr; }
  /// How it feels; null while it is hidden, empty or plain.
  Properties Felt() const { return this->IsThere() ? this->Feel : nullptr; }
  /// Whether what is touched is an older geometry, because the newest is no good.
  bool IsOutdated() const
  {
    return this->Touched() &&
      (this->HasRefused || !this->LastConnectError.empty() || !this->LastMatrixError.empty());
  }
  /// Adds the world's bounds of what is touched, or while that is null of what is being built.
  void AddBounds(vtkBoundingBox& box) const;
  /// The geometry in force, its triangles in the snapshot's order, with its arrays as they were at
  /// the last Pull(); not changed by the actor's matrix. Null where it was never any good.
  vtkPolyData* Prepared() const { return this->Kept; }
  /// For each triangle of the snapshot in force the id of its cell in the geometry given.
  CellIds OriginalCellIds() const { return this->Ids; }

private:
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

  void ListenToErrors();
  bool Connect(std::string& error);
  Version Current();
  void Follow(const PullSettings& settings, std::string& error);
  bool IsThere() const { return this->Shown && !this->IsEmpty; }
  static const char* RemedyFor(vtkDataObject* output);
  vtkPolyData* UpdateGeometry(std::string& error);
  void FollowGeometry(const PullSettings& settings, std::string& error);
  bool FollowMatrix(const PullSettings& settings, std::string& error);
  void RefuseMatrix(std::string& error);
  double LengthOfWay(const RigidPose& pose) const;
  void MoveTo(const RigidPose& pose, const PullSettings& settings);
  void TellJump(const char* what, double way, const PullSettings& settings, bool& wasTold);
  void StartBuild(const PullSettings& settings, std::shared_ptr<SurfacePreparation> preparation,
    std::string& error);
  void TakeBuild(const PullSettings& settings, std::string& error);
  void KeepAttributes(vtkPolyData* geometry);
  void MakeProperties();
  void TellPreparationError();
  void KeepCellIds();
  static void KeepError(vtkObject* caller, unsigned long event, void* clientData, void* text);

  int Identifier;
  std::unique_ptr<SurfaceSource> Source;
  vtkNew<vtkGodObjectFilter> Preparation;
  vtkNew<vtkCallbackCommand> Listener;
  bool Shown = true;
  bool IsEmpty = false;    ///< the geometry has no cells
  bool HasRefused = false; ///< the newest geometry
  bool Gripped = false;
  bool Carried = false;
  bool Tried = false;
  Version LastTried;
  Version LastSeen;
  double SeenAt = 0.0;       ///< the servo's time [s]
  double SeenInterval = 0.0; ///< PullSettings::Interval, then
  double BuildSeenAt = 0.0;  ///< when what is being built was seen
  bool HasRested = false;    ///< before it was seen
  Matrix4 LastMatrix = IdentityMatrix;
  std::string LastConnectError;
  std::string LastMatrixError;
  std::string PreparationError;
  std::string Notice; ///< what is told without anything being refused; whole sentences
  std::shared_ptr<SurfaceBuild> Build;
  vtkSmartPointer<vtkPolyData> BuildInput;    ///< with the arrays as they were when it started
  vtkSmartPointer<vtkIdTypeArray> BuildCells; ///< SurfaceSource::Cells(), likewise

  Snapshot InForce;
  std::shared_ptr<SurfacePreparation> Base;  ///< what InForce was made of
  Matrix4 Baked = IdentityMatrix;            ///< and by which matrix
  std::shared_ptr<SurfaceDeformer> Deformer; ///< what made InForce; null where it was built
  double LastChanged = 0.0;                  ///< when InForce was first seen, servo's time [s]
  bool IsWaiting = false;                    ///< with a changed one, for the servo
  bool IsPostponed = false;                  ///< a build that is done, likewise
  bool WasUnseen = false;                    ///< before this Pull()
  std::uint64_t Jumps = 0;
  std::shared_ptr<SurfaceMotion> Moving;
  RigidPose Placed;
  bool IsElsewhere = false;
  double LastMoved = 0.0;   ///< the servo's time [s]
  bool HasToldJump = false; ///< of the pose, while it goes on jumping
  bool HasToldLeap = false; ///< of points, likewise
  bool NeedsBaking = false;
  bool WasRefused = false; ///< a geometry, for the matrix
  CellIds Ids;
  vtkSmartPointer<vtkIdTypeArray> IdsThrough; ///< SurfaceSource::Cells() that Ids are of
  vtkSmartPointer<vtkPolyData> Kept;
  Properties Feel;                     ///< for InForce
  vtkSmartPointer<vtkPolyData> FeltBy; ///< what Feel was made of, and when
  Snapshot FeltFor;
  vtkMTimeType FeltAt = 0;
};
}

#endif
