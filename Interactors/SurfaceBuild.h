#ifndef SurfaceBuild_h
#define SurfaceBuild_h

#include "ActorMatrix.h"
#include "BackgroundWorker.h"
#include "SurfacePreparation.h"
#include "TriangleSurface.h"

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

  /// Is called with the progress, on the thread that does the work; false stops it.
  void SetProgressCall(ProgressCall call) { this->Listener = std::move(call); }

  const std::shared_ptr<SurfacePreparation>& Preparation() const { return this->Prepared; }
  /// Whether the preparation was new.
  bool Prepares() const { return this->IsNew; }
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
  void BuildAnew();
  void Bake(const TriangleSurface& local);

  std::shared_ptr<SurfacePreparation> Prepared;
  Matrix4 Baked;
  bool IsNew;
  ProgressCall Listener;
  CleaningResult Outcome = CleaningResult::Aborted;
  std::shared_ptr<const TriangleSurface> Built;
  std::string ErrorText;
};
}

#endif
