#include "haptics/Scene/GeometryFollower.h"

#include "haptics/Filters/ErrorText.h"
#include "vtkAlgorithmOutput.h"
#include "vtkBoundingBox.h"
#include "vtkCommand.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataSet.h"
#include "vtkDemandDrivenPipeline.h"
#include "vtkHyperTreeGrid.h"

#include <algorithm>
#include <optional>
#include <utility>

namespace haptics
{
namespace
{
/// What makes polydata of what is connected.
const char* RemedyFor(vtkDataObject* output)
{
  if (vtkCompositeDataSet::SafeDownCast(output))
  {
    return "put a vtkCompositeDataGeometryFilter before it"; // vtkGeometryFilter keeps the blocks
  }
  if (vtkHyperTreeGrid::SafeDownCast(output))
  {
    return "put a vtkHyperTreeGridGeometry before it";
  }
  return vtkDataSet::SafeDownCast(output) ? "put a vtkGeometryFilter before it"
                                          : "connect a source of a surface";
}
}

GeometryFollower::GeometryFollower(SurfaceSource& source, PoseFollower& pose)
  : Source(source)
  , Pose(pose)
{
  // The scene reports them, with the surface that they are about.
  this->Listener->SetClientData(this);
  this->Listener->SetCallback(
    [](vtkObject*, unsigned long, void* self, void* text)
    {
      AppendErrorText(
        static_cast<GeometryFollower*>(self)->FilterError, static_cast<const char*>(text));
    });
  this->Preparation->AddObserver(vtkCommand::ErrorEvent, this->Listener);
}

GeometryFollower::~GeometryFollower()
{
  this->CancelBuild();
  this->Preparation->RemoveObserver(this->Listener); // the filter may live on: it is handed out
}

std::string GeometryFollower::TakeFilterError()
{
  return std::exchange(this->FilterError, {});
}

bool GeometryFollower::Connect(PullReport& report)
{
  std::string error;
  vtkAlgorithmOutput* geometry = this->Source.Geometry(error);
  if (!geometry)
  {
    if (error != this->ConnectError)
    {
      report.Fail(error);
      this->ConnectError = error;
    }
    return false;
  }
  this->ConnectError.clear();
  if (this->Preparation->GetNumberOfInputConnections(0) == 0 ||
    this->Preparation->GetInputConnection(0, 0) != geometry)
  {
    this->Preparation->SetInputConnection(geometry);
  }
  return true;
}

/// What is connected now, and when that was seen first.
GeometryFollower::Version GeometryFollower::Look(const PullSettings& settings)
{
  Version version;
  version.Geometry = this->Preparation->GetInputConnection(0, 0);
  vtkDemandDrivenPipeline* pipeline =
    vtkDemandDrivenPipeline::SafeDownCast(this->Preparation->GetExecutive());
  pipeline->UpdatePipelineMTime();
  version.Pipeline = pipeline->GetPipelineMTime();
  if (!(version == this->LastSeen))
  {
    this->LastSeen = version;
    this->HasRested = settings.Now - this->SeenAt > LongestMotion;
    this->SeenAt = settings.Now;
    this->SeenInterval = settings.Interval;
  }
  return version;
}

void GeometryFollower::Follow(
  bool hasMoved, bool wasUnseen, const PullSettings& settings, PullReport& report)
{
  const Version version = this->Look(settings);
  const bool isNew =
    !this->IsTried || !(version == this->LastTried) || (hasMoved && this->IsRefusedForMatrix);
  // One that comes too soon for the servo waits; another may come before it is its turn.
  // But where nobody steps there is nothing to wait for.
  const bool mayWait = settings.IsLive && !settings.IsTaken && this->InForce &&
    (settings.IsRunning || settings.Interval > 0.0 || this->IsChangeWaiting);
  if (this->Build && isNew && this->InForce)
  {
    PullReport later; // when its turn comes
    vtkPolyData* geometry = this->UpdateGeometry(later);
    if (geometry && geometry->GetNumberOfCells() == 0)
    {
      this->CancelBuild(); // what is being built is gone before it was there
    }
  }
  this->IsChangeWaiting = !this->Build && isNew && mayWait;
  if (!this->Build && isNew && !mayWait)
  {
    this->IsTried = true;
    this->LastTried = version;
    this->IsRefusedForMatrix = false;
    this->Prepare(wasUnseen, settings, report);
  }
  if (!this->Build && this->Pose.GetState() == PoseFollower::State::NeedsBaking)
  {
    if (this->Base->Surface())
    {
      this->BuildInput = nullptr;
      this->StartBuild(this->Base, wasUnseen, settings, report);
    }
    else // deformed meanwhile
    {
      this->Prepare(wasUnseen, settings, report);
    }
    this->Pose.AwaitBaking();
  }
}

/// Null, and an error, where what is connected is no polydata.
vtkPolyData* GeometryFollower::UpdateGeometry(PullReport& report)
{
  vtkAlgorithm* producer = this->Preparation->GetInputAlgorithm();
  const int port = this->Preparation->GetInputConnection(0, 0)->GetIndex();
  producer->Update(port);
  vtkDataObject* output = producer->GetOutputDataObject(port);
  vtkPolyData* geometry = vtkPolyData::SafeDownCast(output);
  if (!geometry)
  {
    report.Fail(std::string("the geometry is ") + (output ? output->GetClassName() : "missing") +
      ", not vtkPolyData; " + RemedyFor(output));
  }
  return geometry;
}

void GeometryFollower::Prepare(bool wasUnseen, const PullSettings& settings, PullReport& report)
{
  vtkPolyData* geometry = this->UpdateGeometry(report);
  this->HasRefused = !geometry;
  if (!geometry)
  {
    return;
  }
  // A contour of a value that does not occur, and the like: nothing to touch. But points that never
  // had cells are somebody's mistake.
  this->HasNoCells = geometry->GetNumberOfCells() == 0;
  if (this->HasNoCells && (this->InForce || geometry->GetNumberOfPoints() == 0))
  {
    return;
  }
  this->FilterError.clear();
  const PreparationOptions options = this->Preparation->GetOptions(geometry);
  report.Note(this->FilterError);
  if (this->Pose.GetState() != PoseFollower::State::NeedsBaking && this->Base &&
    this->Base->Key() == SurfacePreparation::MakeKey(geometry, options))
  {
    this->KeepAttributes(geometry); // a colour has changed, or the like
    return;
  }
  this->BuildInput = vtkSmartPointer<vtkPolyData>::New();
  this->BuildInput->ShallowCopy(geometry);
  this->BuildCells = this->Source.Cells();
  this->StartBuild(
    std::make_shared<SurfacePreparation>(geometry, options), wasUnseen, settings, report);
}

void GeometryFollower::StartBuild(const std::shared_ptr<SurfacePreparation>& preparation,
  bool wasUnseen, const PullSettings& settings, PullReport& report)
{
  const std::optional<Matrix4> baked = this->Pose.MatrixToBake(this->InForce != nullptr, report);
  if (!baked)
  {
    this->IsRefusedForMatrix = true;
    return;
  }
  this->Stage = BuildStage::Builds;
  this->Build = std::make_shared<SurfaceBuild>(preparation, *baked);
  if (this->Build->Prepares() && this->InForce && this->Pose.IsBaked(*baked) && settings.IsLive &&
    settings.IsTaken && !wasUnseen)
  {
    this->DeformWhatIsInForce(settings);
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
  this->TakeBuild(settings, report);
}

/// Where the cells are the same: over as long as the source has taken, however long it had to wait.
void GeometryFollower::DeformWhatIsInForce(const PullSettings& settings)
{
  this->Build->Preparation()->FollowOn(this->Base);
  const double since = this->SeenAt - this->LastChanged; // negative where the servo began anew
  const double duration =
    std::clamp(this->HasRested || since < 0.0 ? this->SeenInterval : since, 0.0, LongestMotion);
  this->Build->DeformFrom(
    this->InForce, this->Deformer, duration, PullSettings::LargestSpeed * settings.Scale);
}

void GeometryFollower::TakeDoneBuild(const PullSettings& settings, PullReport& report)
{
  if (!this->Build || !this->Build->IsDone())
  {
    return;
  }
  const bool hasToWait = this->Build->Deforms() && settings.IsLive && !settings.IsTaken;
  this->Stage = hasToWait ? BuildStage::WaitsForServo : BuildStage::Builds;
  if (!hasToWait)
  {
    this->TakeBuild(settings, report);
  }
}

void GeometryFollower::TakeBuild(const PullSettings& settings, PullReport& report)
{
  const std::shared_ptr<SurfaceBuild> done = std::exchange(this->Build, nullptr);
  this->Stage = BuildStage::Rests;
  this->FilterError.clear();
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
    const std::string& why = done->Error().empty() ? this->FilterError : done->Error();
    report.Fail(why);
    this->HasRefused = this->HasRefused || !why.empty(); // else it was given up
    return;
  }
  report.Note(this->FilterError);
  const bool isOtherGeometry = done->Preparation() != this->Base;
  const bool isOtherFrame = !this->InForce || !this->Pose.IsBaked(done->Matrix());
  this->InForce = done->Snapshot();
  this->Base = done->Preparation();
  this->Deformer = done->Deformer();
  this->LastChanged = this->BuildSeenAt;
  this->Jumps += done->Jump() > 0.0 ? 1 : 0;
  this->Leap.Look("A point of it", done->Jump(), settings, report);
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
    this->Pose.Rebase(*this->InForce, done->Matrix(), settings.Now);
  }
}

void GeometryFollower::CancelBuild()
{
  if (this->Build)
  {
    this->Build->Cancel();
    this->Build.reset();
    this->Stage = BuildStage::Rests;
    this->Deformer.reset(); // the build may go on with it for a while, to a shape nobody touches
  }
}

void GeometryFollower::AddBoundsOfBuild(vtkBoundingBox& box) const
{
  if (this->Build && this->BuildInput)
  {
    vtkBoundingBox local(this->BuildInput->GetBounds());
    for (int i = 0; i < 8; ++i)
    {
      Vec3 corner;
      local.GetCorner(i, corner.data());
      box.AddPoint(Transformed(this->Pose.Matrix(), corner).data());
    }
  }
}

void GeometryFollower::KeepAttributes(vtkPolyData* geometry)
{
  this->InForceData = vtkSmartPointer<vtkPolyData>::New();
  const int dropped = this->Base->Fill(geometry, this->InForceData);
  if (dropped > 0)
  {
    vtkWarningWithObjectMacro(this->Preparation,
      << dropped << " data arrays of the geometry are shorter than its points or cells, "
      << "and were left out.");
  }
}

void GeometryFollower::KeepCellIds()
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
