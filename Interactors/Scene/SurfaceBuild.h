#ifndef Haptics_SurfaceBuild_h
#define Haptics_SurfaceBuild_h

#include "haptics/Filters/SurfacePreparation.h"
#include "haptics/Scene/ActorMatrix.h"
#include "haptics/Scene/BackgroundWorker.h"
#include "haptics/Scene/PullSettings.h"
#include "haptics/Surface/SurfaceDeformer.h"
#include "haptics/Surface/TriangleSurface.h"

#include <functional>
#include <memory>
#include <string>
#include <utility>

namespace haptics
{
/// @brief From a geometry and a matrix to a snapshot, on any thread.
class SurfaceBuild : public BackgroundTask
{
public:
  /// `preparation`: new, or done, where only the matrix is another one. `matrix`: from the
  /// geometry's frame to the snapshot's; affine, neither flat nor infinite.
  SurfaceBuild(std::shared_ptr<SurfacePreparation> preparation, const Matrix4& matrix);

  /// Where the geometry is the one before in another shape, the snapshot becomes `from` deformed
  /// over `duration` [s], or longer where a point would be faster than `largestSpeed` [world unit /
  /// s], and nothing is cleaned or built anew. A patch is built anew and deforms as well.
  /// `deformer`: what made `from`; null where it was built. Before Run(); the preparation was given
  /// what `from` was made of.
  void DeformFrom(std::shared_ptr<const TriangleSurface> from,
    std::shared_ptr<SurfaceDeformer> deformer, double duration, double largestSpeed);

  /// Is called with the progress, on the thread that does the work; false stops it.
  void SetProgressCall(ProgressCall call) { this->Listener = std::move(call); }

  const std::shared_ptr<SurfacePreparation>& Preparation() const { return this->Prepared; }
  /// Whether the preparation was new, and has run.
  bool Prepares() const { return this->IsNew && !this->HasDeformed; }
  /// Whether the snapshot is the one before deformed, and what did it.
  bool Deforms() const { return this->HasDeformed; }
  /// Whether the snapshot goes on from the one before, which has to have been touched then.
  bool GoesOn() const
  {
    return this->HasDeformed ||
      (this->Before && this->Built &&
        (this->Built->Deforms() ||
          (this->Before->Deforms() && this->Built->IsOfSameWhole(*this->Before))));
  }
  const std::shared_ptr<SurfaceDeformer>& Deformer() const { return this->Shaper; }
  /// How far a point had to go that could not in LongestMotion, so that the snapshot takes the
  /// place of the one before at once [world unit]; else 0.
  double Jump() const { return this->JumpedBy; }
  const Matrix4& Matrix() const { return this->Baked; }

  ///@{
  /// Once it is done.
  CleaningResult Result() const { return this->Outcome; }
  /// Null unless the result is Done.
  std::shared_ptr<const TriangleSurface> Snapshot() const { return this->Built; }
  /// Why there is none though the preparation was good.
  const std::string& Error() const { return this->ErrorText; }
  ///@}

protected:
  void Work() override;

private:
  bool Deform();
  double DurationFor(double way);
  void DeformPatch();
  void BuildAnew();
  void Bake(const TriangleSurface& local, const ProgressCall& progress);

  std::shared_ptr<SurfacePreparation> Prepared;
  Matrix4 Baked;
  bool IsNew;
  bool HasDeformed = false;
  std::shared_ptr<const TriangleSurface> Before;
  std::shared_ptr<SurfaceDeformer> Shaper;
  double Duration = 0.0;
  double LargestSpeed = 0.0;
  double JumpedBy = 0.0;
  ProgressCall Listener;
  CleaningResult Outcome = CleaningResult::Aborted;
  std::shared_ptr<const TriangleSurface> Built;
  std::string ErrorText;
};
}

#endif
