#include "haptics/Scene/HapticSurface.h"

#include "haptics/Filters/ErrorText.h"
#include "vtkAlgorithmOutput.h"
#include "vtkBoundingBox.h"
#include "vtkCommand.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataSet.h"
#include "vtkDemandDrivenPipeline.h"
#include "vtkGodObjectFilter.h"
#include "vtkHyperTreeGrid.h"
#include "vtkPolyData.h"

#include <utility>

namespace haptics
{
HapticSurface::HapticSurface(int id, std::unique_ptr<SurfaceSource> source)
  : Identifier(id)
  , Source(std::move(source))
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
  vtkAlgorithmOutput* geometry = this->Source->Geometry(error);
  if (!geometry)
  {
    return false;
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

bool HapticSurface::Pull(const PullSettings& settings, std::string& error)
{
  const Snapshot before = this->Touched();
  const Properties feltBefore = this->Felt();
  this->Follow(settings, error);
  this->HasRefused = this->HasRefused ||
    (!error.empty() && error != this->LastConnectError && error != this->LastMatrixError);
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
  this->WasUnseen = !this->IsThere();
  this->IsElsewhere = false;
  this->Shown = this->Source->IsShown();
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

  const Matrix4 matrix = this->Source->Matrix();
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
  // But where nobody steps there is nothing to wait for.
  const bool mayWait = settings.IsLive && !settings.IsTaken && this->InForce &&
    (settings.IsRunning || settings.Interval > 0.0 || this->IsWaiting);
  if (this->Build && isNew && this->InForce)
  {
    std::string none; // told when its turn comes
    vtkPolyData* geometry = this->UpdateGeometry(none);
    if (geometry && geometry->GetNumberOfCells() == 0)
    {
      this->CancelBuild(); // what is being built is gone before it was there
    }
  }
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

/// What makes polydata of what is connected.
const char* HapticSurface::RemedyFor(vtkDataObject* output)
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

/// Null, and why, where what is connected is no polydata.
vtkPolyData* HapticSurface::UpdateGeometry(std::string& error)
{
  vtkAlgorithm* producer = this->Preparation->GetInputAlgorithm();
  const int port = this->Preparation->GetInputConnection(0, 0)->GetIndex();
  producer->Update(port);
  vtkDataObject* output = producer->GetOutputDataObject(port);
  vtkPolyData* geometry = vtkPolyData::SafeDownCast(output);
  if (!geometry)
  {
    error = std::string("the geometry is ") + (output ? output->GetClassName() : "missing") +
      ", not vtkPolyData; " + RemedyFor(output);
  }
  return geometry;
}

void HapticSurface::FollowGeometry(const PullSettings& settings, std::string& error)
{
  vtkPolyData* geometry = this->UpdateGeometry(error);
  if (!geometry)
  {
    return;
  }
  this->HasRefused = false;
  // A contour of a value that does not occur, and the like: nothing to touch. But points that never
  // had cells are somebody's mistake.
  this->IsEmpty = geometry->GetNumberOfCells() == 0;
  if (this->IsEmpty && (this->InForce || geometry->GetNumberOfPoints() == 0))
  {
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
  this->BuildCells = this->Source->Cells();
  this->StartBuild(settings, std::make_shared<SurfacePreparation>(geometry, options), error);
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
}
