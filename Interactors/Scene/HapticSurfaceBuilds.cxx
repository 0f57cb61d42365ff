// How a HapticSurface builds what is touched, and takes it over.
#include "haptics/Scene/HapticSurface.h"

#include "vtkGodObjectFilter.h"
#include "vtkIdTypeArray.h"

#include <cmath>
#include <optional>
#include <utility>

namespace haptics
{
void HapticSurface::StartBuild(
  const PullSettings& settings, std::shared_ptr<SurfacePreparation> preparation, std::string& error)
{
  const double determinant = Determinant(this->LastMatrix);
  if (!std::isfinite(determinant) || determinant == 0.0)
  {
    this->WasRefused = true;
    this->RefuseMatrix(error);
    return;
  }
  // What is in force stays where it is if it can, so that the servo goes on with its motion.
  Matrix4 baked = this->LastMatrix;
  if (this->InForce && FindPose(this->LastMatrix, this->Baked))
  {
    baked = this->Baked;
  }
  else if (FindPose(this->LastMatrix, IdentityMatrix))
  {
    baked = IdentityMatrix;
  }
  this->Build = std::make_shared<SurfaceBuild>(preparation, baked);
  if (this->Build->Prepares() && this->InForce && AreSame(baked, this->Baked) && settings.IsLive &&
    settings.IsTaken && !this->WasUnseen)
  {
    preparation->FollowOn(this->Base);
    // As long as the source has taken, however long it had to wait.
    const double since = this->SeenAt - this->LastChanged; // negative where the servo began anew
    const double duration =
      std::clamp(this->HasRested || since < 0.0 ? this->SeenInterval : since, 0.0, LongestMotion);
    this->Build->DeformFrom(
      this->InForce, this->Deformer, duration, PullSettings::LargestSpeed * settings.Scale);
  }
  this->BuildSeenAt = this->SeenAt;
  if (settings.Worker)
  {
    if (this->Build->Prepares())
    {
      this->Build->Preparation()->CopyPoints();
    }
    settings.Worker->Start(this->Build);
    return;
  }
  this->Build->SetProgressCall(
    [this](double fraction)
    {
      this->Preparation->UpdateProgress(fraction);
      return !this->Preparation->GetAbortExecute();
    });
  this->Build->Run();
  this->TakeBuild(settings, error);
}

void HapticSurface::TakeBuild(const PullSettings& settings, std::string& error)
{
  const std::shared_ptr<SurfaceBuild> done = std::exchange(this->Build, nullptr);
  this->PreparationError.clear();
  // What failed after the preparation is not its business.
  const bool isPrepared = done->Preparation()->Surface() != nullptr;
  if (done->Prepares() && (isPrepared || done->Error().empty()))
  {
    this->Preparation->Take(
      done->Preparation(), isPrepared ? CleaningResult::Done : done->Result());
  }
  if (done->Deforms())
  {
    done->Preparation()->Finish();
    this->Preparation->TellOfSides(*done->Preparation());
  }
  if (!done->Snapshot())
  {
    error +=
      (error.empty() ? "" : " ") + (done->Error().empty() ? this->PreparationError : done->Error());
    return;
  }
  this->TellPreparationError();
  const bool isOtherGeometry = done->Preparation() != this->Base;
  const bool isOtherFrame = !this->InForce || !AreSame(done->Matrix(), this->Baked);
  this->InForce = done->Snapshot();
  this->Base = done->Preparation();
  this->Deformer = done->Deformer();
  this->Baked = done->Matrix();
  this->LastChanged = this->BuildSeenAt;
  this->Jumps += done->Jump() > 0.0 ? 1 : 0;
  this->TellJump("A point of it", done->Jump(), settings, this->HasToldLeap);
  if (isOtherGeometry)
  {
    if (!done->Deforms() || this->IdsThrough != this->BuildCells)
    {
      this->KeepCellIds();
    }
    this->KeepAttributes(this->BuildInput);
  }
  if (isOtherFrame)
  {
    // Where the actor has been scaled meanwhile, the next build is for that.
    const std::optional<RigidPose> pose = FindPose(this->LastMatrix, this->Baked);
    this->NeedsBaking = !pose;
    this->Placed = pose.value_or(this->Placed);
    this->Moving = this->Source->Moves() ? std::make_shared<SurfaceMotion>(this->Placed,
                                             this->InForce->Origin(), this->InForce->Radius())
                                         : nullptr;
    this->LastMoved = settings.Now;
  }
}

void HapticSurface::CancelBuild()
{
  if (this->Build)
  {
    this->Build->Cancel();
    this->Build.reset();
    this->IsPostponed = false;
    this->Deformer.reset(); // the build may go on with it for a while, to a shape nobody touches
  }
}

void HapticSurface::KeepCellIds()
{
  auto ids = std::make_shared<std::vector<vtkIdType>>();
  vtkIdTypeArray* array = this->Base->OriginalCells();
  ids->assign(array->GetPointer(0), array->GetPointer(0) + array->GetNumberOfValues());
  this->IdsThrough = this->BuildCells;
  if (this->IdsThrough)
  {
    for (vtkIdType& id : *ids)
    {
      id = this->IdsThrough->GetValue(id);
    }
  }
  this->Ids = std::move(ids);
}
}
