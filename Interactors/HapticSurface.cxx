#include "HapticSurface.h"

#include "ErrorText.h"
#include "vtkActor.h"
#include "vtkAlgorithmOutput.h"
#include "vtkBoundingBox.h"
#include "vtkCommand.h"
#include "vtkDemandDrivenPipeline.h"
#include "vtkGodObjectFilter.h"
#include "vtkIdTypeArray.h"
#include "vtkMapper.h"
#include "vtkMatrix4x4.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>
#include <utility>

namespace haptics
{
namespace
{
constexpr double LargestSpeed = 5.0; ///< of a surface that pushes a hand, in the hand [m/s]

/// How long a motion takes: while one comes with each update, or with every other one, the time
/// from one to the next. A surface whose next update comes later than LongestMotion has rested
/// before it.
double DurationSince(double last, const PullSettings& settings)
{
  const double since = settings.Now - last;
  const double duration = since > 0.0 && since <= LongestMotion ? since : settings.Interval;
  return std::clamp(duration, 0.0, LongestMotion);
}
}

HapticSurface::HapticSurface(int id, vtkActor* actor)
  : Identifier(id)
  , Source(actor)
{
  this->ListenToErrors();
}

HapticSurface::HapticSurface(int id, vtkAlgorithmOutput* geometry)
  : Identifier(id)
  , Producer(geometry->GetProducer())
  , Geometry(geometry)
{
  this->ListenToErrors();
}

HapticSurface::~HapticSurface()
{
  this->CancelBuild();
  this->Preparation->RemoveObserver(this->Listener); // the filter may live on: it is handed out
}

void HapticSurface::ListenToErrors()
{
  // The scene reports them, with the surface that they are about.
  this->Listener->SetClientData(this);
  this->Listener->SetCallback(HapticSurface::KeepError);
  this->Preparation->AddObserver(vtkCommand::ErrorEvent, this->Listener);
}

void HapticSurface::KeepError(vtkObject*, unsigned long, void* clientData, void* text)
{
  auto* self = static_cast<HapticSurface*>(clientData);
  AppendErrorText(self->PreparationError, static_cast<const char*>(text));
}

bool HapticSurface::Connect(std::string& error)
{
  vtkAlgorithmOutput* geometry = this->Geometry;
  if (this->Source)
  {
    vtkMapper* mapper = this->Source->GetMapper();
    geometry = mapper ? mapper->GetInputConnection(0, 0) : nullptr;
    if (!geometry)
    {
      error = mapper ? "the actor's mapper has no input; give it some"
                     : "the actor has no mapper; give it one";
      return false;
    }
  }
  if (this->Preparation->GetNumberOfInputConnections(0) == 0 ||
    this->Preparation->GetInputConnection(0, 0) != geometry)
  {
    this->Preparation->SetInputConnection(geometry);
  }
  return true;
}

HapticSurface::Version HapticSurface::Current()
{
  Version version;
  version.Geometry = this->Preparation->GetInputConnection(0, 0);
  vtkDemandDrivenPipeline* pipeline =
    vtkDemandDrivenPipeline::SafeDownCast(this->Preparation->GetExecutive());
  pipeline->UpdatePipelineMTime();
  version.Pipeline = pipeline->GetPipelineMTime();
  return version;
}

Matrix4 HapticSurface::CurrentMatrix()
{
  Matrix4 matrix = IdentityMatrix;
  if (this->Source)
  {
    this->Source->GetMatrix(matrix.data());
  }
  return matrix;
}

bool HapticSurface::Pull(const PullSettings& settings, std::string& error)
{
  const Snapshot before = this->Touched();
  const Properties feltBefore = this->Felt();
  this->Follow(settings, error);
  if (!error.empty())
  {
    error += std::string(error.back() == '.' ? "" : ".") +
      (this->Touched() ? " What was touched before stays in force." : " It cannot be touched.");
  }
  if (this->InForce)
  {
    this->MakeProperties();
  }
  error += (error.empty() || this->Notice.empty() ? "" : " ") + std::exchange(this->Notice, {});
  return this->Touched() != before || this->Felt() != feltBefore;
}

void HapticSurface::Follow(const PullSettings& settings, std::string& error)
{
  this->WasUnseen = !this->Shown;
  this->IsElsewhere = false;
  this->Shown = !this->Source || (this->Source->GetVisibility() && this->Source->GetPickable());
  // One that goes on from a snapshot has to come after it.
  const bool isDone = this->Build && this->Build->IsDone();
  this->IsPostponed = isDone && this->Build->Deforms() && settings.IsLive && !settings.IsTaken;
  if (isDone && !this->IsPostponed)
  {
    this->TakeBuild(settings, error);
  }
  if (!this->Shown)
  {
    return;
  }
  std::string connectError;
  if (!this->Connect(connectError))
  {
    if (connectError != this->LastConnectError)
    {
      error = connectError;
      this->LastConnectError = connectError;
    }
    return;
  }
  this->LastConnectError.clear();

  const Matrix4 matrix = this->CurrentMatrix();
  const bool hasMoved = !AreSame(matrix, this->LastMatrix);
  this->LastMatrix = matrix;
  const bool isCarried = std::exchange(this->Carried, false);
  if (hasMoved && this->InForce)
  {
    PullSettings moving = settings;
    moving.IsLive = settings.IsLive && !isCarried;
    this->NeedsBaking = !this->FollowMatrix(moving, error);
  }
  if (this->WasUnseen && this->Moving)
  {
    this->Moving->JumpTo(this->Placed); // what moved unseen must not push the hand now
  }
  const Version version = this->Current();
  if (!(version == this->LastSeen))
  {
    this->LastSeen = version;
    this->HasRested = settings.Now - this->SeenAt > LongestMotion;
    this->SeenAt = settings.Now;
    this->SeenInterval = settings.Interval;
  }
  const bool isNew =
    !this->Tried || !(version == this->LastTried) || (hasMoved && this->WasRefused);
  // One that comes too soon for the servo waits; another may come before it is its turn.
  // But where no time passes there is nothing to wait for.
  const bool mayWait = settings.IsLive && !settings.IsTaken && this->InForce &&
    (settings.Interval > 0.0 || this->IsWaiting);
  this->IsWaiting = !this->Build && isNew && mayWait;
  if (!this->Build && isNew && !mayWait)
  {
    this->Tried = true;
    this->LastTried = version;
    this->WasRefused = false;
    this->FollowGeometry(settings, error);
  }
  if (!this->Build && this->NeedsBaking)
  {
    if (this->Base->Surface())
    {
      this->BuildInput = nullptr;
      this->StartBuild(settings, this->Base, error);
    }
    else // deformed meanwhile
    {
      this->FollowGeometry(settings, error);
    }
    this->NeedsBaking = false;
  }
}

void HapticSurface::FollowGeometry(const PullSettings& settings, std::string& error)
{
  vtkAlgorithm* producer = this->Preparation->GetInputAlgorithm();
  const int port = this->Preparation->GetInputConnection(0, 0)->GetIndex();
  producer->Update(port);
  vtkDataObject* output = producer->GetOutputDataObject(port);
  vtkPolyData* geometry = vtkPolyData::SafeDownCast(output);
  if (!geometry)
  {
    error = std::string("the geometry is ") + (output ? output->GetClassName() : "missing") +
      ", not vtkPolyData; put a vtkGeometryFilter before it";
    return;
  }
  this->PreparationError.clear();
  const PreparationOptions options = this->Preparation->GetOptions(geometry);
  this->TellPreparationError();
  if (!this->NeedsBaking && this->Base &&
    this->Base->Key() == SurfacePreparation::MakeKey(geometry, options))
  {
    this->KeepAttributes(geometry); // a colour has changed, or the like
    return;
  }
  this->BuildInput = vtkSmartPointer<vtkPolyData>::New();
  this->BuildInput->ShallowCopy(geometry);
  this->StartBuild(settings, std::make_shared<SurfacePreparation>(geometry, options), error);
}

/// False where the snapshot needs another matrix baked into it.
bool HapticSurface::FollowMatrix(const PullSettings& settings, std::string& error)
{
  const double determinant = Determinant(this->LastMatrix);
  if (!std::isfinite(determinant) || determinant == 0.0)
  {
    this->RefuseMatrix(error);
    return true;
  }
  const std::optional<RigidPose> pose = FindPose(this->LastMatrix, this->Baked);
  if (pose)
  {
    this->LastMatrixError.clear();
    this->MoveTo(*pose, settings);
  }
  return pose.has_value();
}

void HapticSurface::RefuseMatrix(std::string& error)
{
  const std::string text =
    "the actor's matrix flattens it or is not finite; check its scale and user matrix";
  if (text != this->LastMatrixError)
  {
    error = text;
    this->LastMatrixError = text;
  }
}

void HapticSurface::MoveTo(const RigidPose& pose, const PullSettings& settings)
{
  if (pose == this->Placed)
  {
    return;
  }
  const double duration = DurationSince(this->LastMoved, settings);
  this->LastMoved = settings.Now;
  const double way = this->LengthOfWay(pose);
  const double largestSpeed = LargestSpeed * settings.Scale;
  const bool isTooFast = settings.IsLive && way > largestSpeed * LongestMotion;
  if (!settings.IsLive || isTooFast)
  {
    this->Moving->JumpTo(pose);
  }
  else
  {
    this->Moving->SetLargestSpeed(largestSpeed);
    this->Moving->MoveTo(pose, duration);
  }
  this->Placed = pose;
  this->IsElsewhere = true;
  this->TellJump("It", isTooFast ? way : 0.0, settings, this->HasToldJump);
}

/// Once, until a motion is no jump. `way`: of the jump [world unit]; 0: it is none.
void HapticSurface::TellJump(
  const char* what, double way, const PullSettings& settings, bool& wasTold)
{
  const bool isJump = way > 0.0;
  if (isJump && !wasTold)
  {
    std::ostringstream text;
    text.precision(3);
    text << what << " was moved by " << way / settings.Scale
         << " m in the hand from one update to the next, where a hand can be pushed by "
         << LargestSpeed * LongestMotion << " m at most (" << LargestSpeed << " m/s for "
         << LongestMotion << " s). It was put in its new place at once and has pushed nothing. "
         << "Move it in smaller steps, or let the device reach farther (ScaleWorkspace).";
    this->Notice += (this->Notice.empty() ? "" : " ") + text.str();
  }
  wasTold = isJump;
}

double HapticSurface::LengthOfWay(const RigidPose& pose) const
{
  const Vec3 from = this->Placed.PointToWorld(this->InForce->Origin());
  const Vec3 to = pose.PointToWorld(this->InForce->Origin());
  double cosine = 0.0;
  for (std::size_t i = 0; i < 4; ++i)
  {
    cosine += pose.Rotation[i] * this->Placed.Rotation[i];
  }
  const double angle = 2.0 * std::acos(std::min(1.0, std::abs(cosine)));
  return std::hypot(to[0] - from[0], to[1] - from[1], to[2] - from[2]) +
    angle * this->InForce->Radius();
}

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
    this->Build->DeformFrom(this->InForce, this->Deformer, duration, LargestSpeed * settings.Scale);
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
    if (!done->Deforms())
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
    this->Moving = this->Source ? std::make_shared<SurfaceMotion>(
                                    this->Placed, this->InForce->Origin(), this->InForce->Radius())
                                : nullptr;
    this->LastMoved = settings.Now;
  }
}

Vec3 HapticSurface::PointInActor(const Vec3& point) const
{
  if (this->Baked == IdentityMatrix)
  {
    return point;
  }
  Matrix4 inverse;
  vtkMatrix4x4::Invert(this->Baked.data(), inverse.data());
  return Transformed(inverse, point);
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

void HapticSurface::AddBounds(vtkBoundingBox& box) const
{
  if (const Snapshot touched = this->Touched())
  {
    const Vec3& origin = touched->Origin();
    for (const Vec3& point : touched->Points())
    {
      box.AddPoint(
        this->Placed
          .PointToWorld({ point[0] + origin[0], point[1] + origin[1], point[2] + origin[2] })
          .data());
    }
  }
  else if (this->Build && this->BuildInput)
  {
    vtkBoundingBox local(this->BuildInput->GetBounds());
    for (int i = 0; i < 8; ++i)
    {
      Vec3 corner;
      local.GetCorner(i, corner.data());
      box.AddPoint(Transformed(this->LastMatrix, corner).data());
    }
  }
}

void HapticSurface::KeepAttributes(vtkPolyData* geometry)
{
  this->Kept = vtkSmartPointer<vtkPolyData>::New();
  const int dropped = this->Base->Fill(geometry, this->Kept);
  if (dropped > 0)
  {
    vtkWarningWithObjectMacro(this->Preparation,
      << dropped << " data arrays of the geometry are shorter than its points or cells, "
      << "and were left out.");
  }
}

void HapticSurface::MakeProperties()
{
  const vtkMTimeType changed = this->Preparation->GetMTime();
  if (this->FeltBy == this->Kept && this->FeltFor == this->InForce && this->FeltAt == changed)
  {
    return;
  }
  this->PreparationError.clear();
  this->Feel = this->Preparation->MakeProperties(this->Kept, this->InForce);
  this->FeltBy = this->Kept;
  this->FeltFor = this->InForce;
  this->FeltAt = changed;
  this->TellPreparationError();
}

/// What was reported though the surface can be touched.
void HapticSurface::TellPreparationError()
{
  this->Notice +=
    (this->Notice.empty() || this->PreparationError.empty() ? "" : " ") + this->PreparationError;
}

void HapticSurface::KeepCellIds()
{
  auto ids = std::make_shared<std::vector<vtkIdType>>();
  vtkIdTypeArray* array = this->Base->OriginalCells();
  ids->assign(array->GetPointer(0), array->GetPointer(0) + array->GetNumberOfValues());
  this->Ids = std::move(ids);
}
}
