#include "haptics/Scene/GeometryFollower.h"

#include "haptics/Filters/ErrorText.h"
#include "haptics/Filters/PlacedBounds.h"
#include "vtkAlgorithmOutput.h"
#include "vtkBoundingBox.h"
#include "vtkBox.h"
#include "vtkCommand.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataSet.h"
#include "vtkDemandDrivenPipeline.h"
#include "vtkHapticPatchAlgorithm.h"
#include "vtkHyperTreeGrid.h"
#include "vtkMatrix4x4.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace haptics
{
namespace
{
/// The thread that asks for patches waits for them; so it has half of its time for others.
constexpr double PauseAfterPatch = 1.0;

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
    this->Patches = vtkHapticPatchAlgorithm::SafeDownCast(geometry->GetProducer());
    this->Planner.reset();
    this->LastBeam.reset();
    this->Fetching.reset();
    this->Asked.reset();
    this->SurveyTried = 0;
  }
  return true;
}

/// Asks for the patch that the hand needs next; before there is one, for one in the middle.
void GeometryFollower::FollowHand(const PullSettings& settings, PullReport& report)
{
  if (!this->Patches || (this->Planner && !settings.Hand))
  {
    return;
  }
  if (this->Patches->GetMTime() != this->SurveyTried)
  {
    const bool isKnown = this->Patches->Survey();
    this->SurveyTried = this->Patches->GetMTime();
    if (!isKnown)
    {
      report.Fail("its pieces cannot be touched, as its vtkHapticPatchSource reports");
    }
    this->Planner = isKnown && !this->Planner
      ? std::optional<PatchPlanner>(std::in_place, this->Patches->GetPatchRadiusInUse(),
          this->Patches->GetsInBackground() && settings.Worker ? 0.0 : PauseAfterPatch)
      : isKnown ? this->Planner
                : std::nullopt;
  }
  if (!this->Planner)
  {
    return;
  }
  if (std::exchange(this->PlannedSurface, this->Patches->GetVersion()) !=
    this->Patches->GetVersion())
  {
    this->Planner->Renew(); // a patch is asked for in any case: so for one where the hand is now
  }
  HandState hand;
  if (settings.Hand)
  {
    hand = *settings.Hand;
    hand.Hip = this->PointInGeometry(hand.Hip);
    hand.Position = this->PointInGeometry(hand.Position);
  }
  else
  {
    double bounds[6];
    this->Patches->GetSurfaceBounds(bounds);
    vtkBoundingBox(bounds).GetCenter(hand.Hip.data());
    hand.Position = hand.Hip;
  }
  if (const std::optional<PatchRequest> request = this->Planner->Plan(hand))
  {
    this->Fetching = request;
  }
  // Virtual time waits for the data, and so does who waits for the first snapshot.
  const bool waits = !settings.Worker || !this->InForce;
  if (this->Fetching && (waits || this->Patches->Fetch(this->Fetching->Region)))
  {
    this->Ask(*this->Fetching);
    this->Fetching.reset();
  }
}

void GeometryFollower::Ask(const PatchRequest& request)
{
  const bool wasLost = std::exchange(this->Asked, request).has_value();
  if (wasLost)
  {
    this->Patches->Modified(); // even the same region is another question
  }
  const PatchRegion& region = request.Region;
  if (request.IsUpToSurface)
  {
    this->Patches->SetRegionUpToSurface(region.From.data(), region.To.data(), region.Radius);
  }
  else
  {
    this->Patches->SetRegion(region.From.data(), region.To.data(), region.Radius);
  }
  this->SurveyTried = this->Patches->GetMTime(); // that is not another surface
}

/// A point of the world.
Vec3 GeometryFollower::PointInGeometry(const Vec3& point) const
{
  if (this->Pose.Matrix() == IdentityMatrix || Determinant(this->Pose.Matrix()) == 0.0)
  {
    return point;
  }
  Matrix4 inverse;
  vtkMatrix4x4::Invert(this->Pose.Matrix().data(), inverse.data());
  return Transformed(inverse, point);
}

/// Gets what is around a ray, unless it is known. False where that fails.
bool GeometryFollower::Look(const PatchRegion& beam)
{
  const auto isKnown = [&]
  {
    const PatchRegion& known = this->LastBeam->Region;
    return this->LastBeam->Version == this->Patches->GetVersion() &&
      known.DistanceTo(beam.From) < known.Radius && known.DistanceTo(beam.To) < known.Radius;
  };
  if (!this->Patches->Survey() || (this->LastBeam && isKnown()))
  {
    return this->LastBeam.has_value();
  }
  this->LastBeam.reset();
  vtkNew<vtkPolyData> patch;
  if (!this->Patches->MakePatch(beam, patch))
  {
    return false;
  }
  this->LastBeam = Beam{ this->Patches->GetVersion(), beam, nullptr };
  if (patch->GetNumberOfPolys() + patch->GetNumberOfStrips() > 0)
  {
    SurfacePreparation preparation(patch, this->Preparation->GetOptions(patch));
    preparation.Run({});
    this->LastBeam->Surface = preparation.Surface();
  }
  return true;
}

std::optional<RayHit> GeometryFollower::CastRayThroughPatches(
  const Vec3& from, const Vec3& direction)
{
  double bounds[6];
  this->Patches->GetSurfaceBounds(bounds);
  const double radius = this->Patches->GetPatchRadiusInUse();
  vtkBoundingBox box(bounds);
  box.Inflate(radius);
  const Vec3 start = this->PointInGeometry(from);
  const Vec3 end = this->PointInGeometry(
    { from[0] + direction[0], from[1] + direction[1], from[2] + direction[2] });
  const Vec3 way{ end[0] - start[0], end[1] - start[1], end[2] - start[2] };
  // The part of the ray within the box of the surface.
  box.GetBounds(bounds);
  double first = 0.0;
  double last = 0.0;
  int planes[2];
  if (!vtkBox::IntersectWithInfiniteLine(
        bounds, start.data(), end.data(), first, last, nullptr, nullptr, planes[0], planes[1]))
  {
    return std::nullopt;
  }
  first = std::max(first, 0.0);
  if (!(first < last) || !std::isfinite(last))
  {
    return std::nullopt;
  }
  const auto at = [&](double share) {
    return Vec3{ start[0] + share * way[0], start[1] + share * way[1], start[2] + share * way[2] };
  };
  if (!this->Look({ at(first), at(last), radius }) || !this->LastBeam->Surface)
  {
    return std::nullopt;
  }
  std::optional<RayHit> hit = CastRay(*this->LastBeam->Surface, start, way);
  if (hit && this->Pose.Matrix() != IdentityMatrix)
  {
    // As a plane's normal: by the transposed inverse.
    Matrix4 inverse;
    vtkMatrix4x4::Invert(this->Pose.Matrix().data(), inverse.data());
    const Vec3 n = hit->Normal;
    for (int axis = 0; axis < 3; ++axis)
    {
      hit->Normal[axis] =
        inverse[axis] * n[0] + inverse[4 + axis] * n[1] + inverse[8 + axis] * n[2];
    }
    const double length = std::hypot(hit->Normal[0], hit->Normal[1], hit->Normal[2]);
    for (double& coordinate : hit->Normal)
    {
      coordinate /= length;
    }
  }
  return hit;
}

void GeometryFollower::ForgetAsked()
{
  this->Fetching.reset();
  this->Asked.reset();
  if (this->Planner)
  {
    this->Planner->Forget();
  }
}

bool GeometryFollower::AddBoundsOfPatches(vtkBoundingBox& box) const
{
  if (!this->Patches || !this->Planner)
  {
    return false;
  }
  double bounds[6];
  this->Patches->GetSurfaceBounds(bounds);
  box.AddBox(PlacedBounds(bounds, this->Pose.Matrix().data()));
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
    const vtkTypeUInt64 surface = this->Patches ? this->Patches->GetVersion() : 0;
    if (surface != 0 && std::exchange(this->SeenSurface, surface) == surface)
    {
      return version; // another patch of it is no change
    }
    this->HasRested = settings.Now - this->SeenAt > LongestMotion;
    this->SeenAt = settings.Now;
    this->SeenInterval = settings.Interval;
  }
  return version;
}

void GeometryFollower::Follow(
  bool hasMoved, bool wasUnseen, const PullSettings& settings, PullReport& report)
{
  this->FollowHand(settings, report);
  const Version version = this->Look(settings);
  const bool isNew =
    !this->IsTried || !(version == this->LastTried) || (hasMoved && this->IsRefusedForMatrix);
  // One that comes too soon for the servo waits; another may come before it is its turn.
  // But where nobody steps there is nothing to wait for.
  const bool mayWait = settings.IsLive && !settings.IsTaken && this->InForce &&
    (settings.IsRunning || settings.Interval > 0.0 || this->IsChangeWaiting);
  if (this->Build && isNew && this->InForce && !this->Patches)
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
  this->HasNoCells = geometry->GetNumberOfCells() == 0 && !this->Patches;
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
  const bool hasToWait = this->Build->GoesOn() && settings.IsLive && !settings.IsTaken;
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
    this->ForgetAsked();
    this->HasRefused = this->HasRefused || !why.empty(); // else it was given up
    return;
  }
  report.Note(this->FilterError);
  if (this->Asked)
  {
    this->Planner->Receive(settings.Hand ? settings.Now : this->Asked->Time, *this->Asked);
    this->Asked.reset();
  }
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
    this->ForgetAsked();
    this->Deformer.reset(); // the build may go on with it for a while, to a shape nobody touches
  }
}

void GeometryFollower::AddBoundsOfBuild(vtkBoundingBox& box) const
{
  if (this->Build && this->BuildInput)
  {
    box.AddBox(PlacedBounds(this->BuildInput->GetBounds(), this->Pose.Matrix().data()));
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
