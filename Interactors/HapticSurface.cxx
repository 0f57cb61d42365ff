#include "HapticSurface.h"

#include "vtkActor.h"
#include "vtkAlgorithmOutput.h"
#include "vtkBoundingBox.h"
#include "vtkCallbackCommand.h"
#include "vtkCommand.h"
#include "vtkDemandDrivenPipeline.h"
#include "vtkGodObjectFilter.h"
#include "vtkIdTypeArray.h"
#include "vtkMapper.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace haptics
{
namespace
{
/// Equal, where a NaN equals itself: a matrix that stays broken has not moved.
bool IsSame(const Matrix4& a, const Matrix4& b)
{
  return std::equal(a.begin(), a.end(), b.begin(),
    [](double x, double y) { return x == y || (std::isnan(x) && std::isnan(y)); });
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
}

void HapticSurface::ListenToErrors()
{
  // The scene reports them, with the surface that they are about.
  vtkNew<vtkCallbackCommand> listener;
  listener->SetClientData(this);
  listener->SetCallback(HapticSurface::KeepError);
  this->Preparation->AddObserver(vtkCommand::ErrorEvent, listener);
}

void HapticSurface::KeepError(vtkObject*, unsigned long, void* clientData, void* text)
{
  auto* self = static_cast<HapticSurface*>(clientData);
  // "ERROR: In file, line 1\nvtkClass (0x1): what happened\n\n" -> "what happened"
  std::string message = static_cast<const char*>(text);
  const std::size_t start = message.find("): ");
  if (start != std::string::npos)
  {
    message.erase(0, start + 3);
  }
  message.erase(message.find_last_not_of(" \n") + 1);
  self->PreparationError += (self->PreparationError.empty() ? "" : " ") + message;
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
  this->Shown = !this->Source || (this->Source->GetVisibility() && this->Source->GetPickable());
  if (this->Build && this->Build->IsDone())
  {
    this->TakeBuild(error);
  }
  if (!this->Shown || this->Build)
  {
    return this->Touched() != before;
  }
  std::string connectError;
  if (!this->Connect(connectError))
  {
    if (connectError != this->LastConnectError)
    {
      error = connectError;
      this->LastConnectError = connectError;
    }
    return this->Touched() != before;
  }
  this->LastConnectError.clear();

  const Version version = this->Current();
  const Matrix4 matrix = this->CurrentMatrix();
  const bool isNew = !this->Tried || !(version == this->LastTried);
  const bool hasMoved = !IsSame(matrix, this->LastMatrix);
  this->Tried = true;
  this->LastTried = version;
  this->LastMatrix = matrix;
  if (isNew)
  {
    this->FollowGeometry(settings, error);
  }
  else if (hasMoved && this->InForce)
  {
    this->FollowMatrix(settings, error);
  }
  return this->Touched() != before;
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
  const PreparationOptions options = this->Preparation->GetOptions();
  if (this->Base && this->Base->Key() == SurfacePreparation::MakeKey(geometry, options))
  {
    this->KeepAttributes(geometry); // a colour has changed, or the like
    if (this->LastMatrix != this->Baked)
    {
      this->FollowMatrix(settings, error);
    }
    return;
  }
  this->BuildInput = vtkSmartPointer<vtkPolyData>::New();
  this->BuildInput->ShallowCopy(geometry);
  this->StartBuild(
    settings, std::make_shared<SurfacePreparation>(geometry, options), this->LastMatrix, error);
}

void HapticSurface::FollowMatrix(const PullSettings& settings, std::string& error)
{
  this->BuildInput = nullptr;
  this->StartBuild(settings, this->Base, this->LastMatrix, error);
}

void HapticSurface::StartBuild(const PullSettings& settings,
  std::shared_ptr<SurfacePreparation> preparation, const Matrix4& matrix, std::string& error)
{
  const double determinant = Determinant(matrix);
  if (!std::isfinite(determinant) || determinant == 0.0)
  {
    error = "the actor's matrix flattens it or is not finite; check its scale and user matrix";
    return;
  }
  this->Build = std::make_shared<SurfaceBuild>(std::move(preparation), matrix);
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
  this->TakeBuild(error);
}

void HapticSurface::TakeBuild(std::string& error)
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
  if (!done->Snapshot())
  {
    error = done->Error().empty() ? this->PreparationError : done->Error();
    return;
  }
  const bool isOtherGeometry = done->Preparation() != this->Base;
  this->InForce = done->Snapshot();
  this->Base = done->Preparation();
  this->Baked = done->Matrix();
  if (isOtherGeometry)
  {
    this->KeepCellIds();
    this->KeepAttributes(this->BuildInput);
  }
}

void HapticSurface::CancelBuild()
{
  if (this->Build)
  {
    this->Build->Cancel();
    this->Build.reset();
  }
}

void HapticSurface::AddBounds(vtkBoundingBox& box) const
{
  if (const Snapshot touched = this->Touched())
  {
    const Vec3& origin = touched->Origin();
    for (const Vec3& point : touched->Points())
    {
      box.AddPoint(point[0] + origin[0], point[1] + origin[1], point[2] + origin[2]);
    }
  }
  else if (this->Build && this->BuildInput)
  {
    vtkBoundingBox local(this->BuildInput->GetBounds());
    for (int i = 0; i < 8; ++i)
    {
      Vec3 corner;
      local.GetCorner(i, corner.data());
      box.AddPoint(Transformed(this->Build->Matrix(), corner).data());
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

void HapticSurface::KeepCellIds()
{
  auto ids = std::make_shared<std::vector<vtkIdType>>();
  vtkIdTypeArray* array = this->Base->OriginalCells();
  ids->assign(array->GetPointer(0), array->GetPointer(0) + array->GetNumberOfValues());
  this->Ids = std::move(ids);
}
}
