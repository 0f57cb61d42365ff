#ifndef Haptics_PoseFollower_h
#define Haptics_PoseFollower_h

#include "haptics/Math/RigidPose.h"
#include "haptics/Math/Vec3.h"
#include "haptics/Scene/ActorMatrix.h"
#include "haptics/Scene/JumpNotice.h"
#include "haptics/Scene/PullSettings.h"
#include "haptics/Surface/SurfaceMotion.h"
#include "haptics/Surface/TriangleSurface.h"

#include <memory>
#include <optional>

namespace haptics
{
/// @brief How a surface follows its actor's matrix, which is split into what moves and what is
/// baked into the snapshot's points:
///
///     matrix = Pose() * Baked()
///
/// The pose is rigid and goes to the servo as it is, so an actor that is dragged costs nothing but
/// that. Scale, shear and mirror are baked: where they change a new snapshot is needed. GUI thread.
class PoseFollower
{
public:
  enum class State
  {
    Follows,      ///< the snapshot is where the matrix says
    NeedsBaking,  ///< another matrix has to be baked into a snapshot; it stays where it was
    AwaitsBaking, ///< that snapshot has been asked for; likewise, also where it does not come
    Refused       ///< the matrix is flat or not finite; likewise
  };

  /// `moves`: whether the matrix may change.
  explicit PoseFollower(bool moves)
    : Moves(moves)
  {
  }
  State GetState() const { return this->Now; }

  /// Takes the matrix as it is now; whether it is another one than before.
  bool Take(const Matrix4& matrix);
  /// Brings the snapshot in force to where the matrix says, if it can be brought there.
  void Follow(const TriangleSurface& inForce, const PullSettings& settings, PullReport& report);
  /// The servo gets to the pose at once: what moved unseen must not push the hand now.
  void JumpToPose();

  /// What to bake into the next snapshot. `hasSnapshot`: what is in force stays in its frame if it
  /// can, so that the servo goes on with its motion. Nothing, and an error, where it is refused.
  std::optional<Matrix4> MatrixToBake(bool hasSnapshot, PullReport& report);
  /// What NeedsBaking is for was asked for.
  void AwaitBaking()
  {
    this->Now = this->Now == State::NeedsBaking ? State::AwaitsBaking : this->Now;
  }
  /// Whether a snapshot with this matrix has the frame of the one in force.
  bool IsBaked(const Matrix4& matrix) const { return AreSame(matrix, this->BakedMatrix); }
  /// A snapshot has come into force, with another matrix baked into it than the one before or as
  /// the first. `now`: the servo's time [s].
  void Rebase(const TriangleSurface& inForce, const Matrix4& baked, double now);

  /// Before each Pull().
  void BeginPull() { this->IsElsewhere = false; }
  /// Whether the last Pull() found it in another place.
  bool HasMoved() const { return this->IsElsewhere; }
  /// As of the last Take().
  const Matrix4& Matrix() const { return this->LastMatrix; }
  const RigidPose& Pose() const { return this->Placed; }
  /// What the servo follows; null where the matrix does not change.
  std::shared_ptr<SurfaceMotion> Motion() const { return this->Moving; }
  /// A point of the frame that Pose() moves, in that of the geometry.
  Vec3 PointInGeometry(const Vec3& point) const;

private:
  bool Check(PullReport& report);
  double LengthOfWay(const TriangleSurface& inForce, const RigidPose& pose) const;
  void MoveTo(const RigidPose& pose, const TriangleSurface& inForce, const PullSettings& settings,
    PullReport& report);

  bool Moves;
  State Now = State::Follows;
  Matrix4 LastMatrix = IdentityMatrix;
  Matrix4 BakedMatrix = IdentityMatrix;
  RigidPose Placed;
  std::shared_ptr<SurfaceMotion> Moving;
  bool IsElsewhere = false;
  double LastMoved = 0.0; ///< the servo's time [s]
  JumpNotice Jump;
};
}

#endif
