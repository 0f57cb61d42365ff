#include "HapticSurface.h"

#include "vtkActor.h"
#include "vtkAlgorithmOutput.h"
#include "vtkCallbackCommand.h"
#include "vtkCellData.h"
#include "vtkCommand.h"
#include "vtkDemandDrivenPipeline.h"
#include "vtkGodObjectFilter.h"
#include "vtkIdTypeArray.h"
#include "vtkMapper.h"
#include "vtkMatrix4x4.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace haptics
{
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

HapticSurface::~HapticSurface() = default;

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
    this->Source->GetMatrix(this->Matrix);
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
  std::copy_n(this->Matrix->GetData(), 16, version.Matrix.begin());
  return version;
}

bool HapticSurface::Pull(std::string& error)
{
  const Snapshot before = this->Touched();
  this->Shown = !this->Source || (this->Source->GetVisibility() && this->Source->GetPickable());
  if (!this->Shown)
  {
    return before != nullptr;
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
  if (!this->Tried || !(version == this->LastTried))
  {
    this->Tried = true;
    this->LastTried = version;
    this->Build(error);
  }
  return this->Touched() != before;
}

bool HapticSurface::Build(std::string& error)
{
  vtkAlgorithm* producer = this->Preparation->GetInputAlgorithm();
  const int port = this->Preparation->GetInputConnection(0, 0)->GetIndex();
  producer->Update(port);
  vtkDataObject* geometry = producer->GetOutputDataObject(port);
  if (!vtkPolyData::SafeDownCast(geometry))
  {
    error = std::string("the geometry is ") + (geometry ? geometry->GetClassName() : "missing") +
      ", not vtkPolyData; put a vtkGeometryFilter before it";
    return false;
  }
  this->PreparationError.clear();
  this->Preparation->Update();
  const Snapshot local = this->Preparation->GetSurface();
  if (!local)
  {
    error = this->PreparationError;
    return false;
  }
  std::array<double, 16> matrix;
  std::copy_n(this->Matrix->GetData(), 16, matrix.begin());
  if (local == this->Untransformed && matrix == this->MatrixInForce)
  {
    this->KeepPrepared();
    return true; // a colour has changed, or the like
  }
  Snapshot built = this->Matrix->IsIdentity() ? local : this->Transform(local, error);
  if (!built)
  {
    return false;
  }
  if (local != this->Untransformed)
  {
    this->KeepCellIds();
  }
  this->InForce = std::move(built);
  this->Untransformed = local;
  this->MatrixInForce = matrix;
  this->KeepPrepared();
  return true;
}

void HapticSurface::KeepPrepared()
{
  this->Kept = vtkSmartPointer<vtkPolyData>::New();
  this->Kept->ShallowCopy(this->Preparation->GetOutput());
}

void HapticSurface::KeepCellIds()
{
  auto ids = std::make_shared<std::vector<vtkIdType>>();
  vtkDataArray* array = this->Preparation->GetOutput()->GetCellData()->GetArray("OriginalCellId");
  const vtkIdType count = array ? array->GetNumberOfTuples() : 0;
  ids->reserve(static_cast<std::size_t>(count));
  if (vtkIdTypeArray* exact = vtkIdTypeArray::SafeDownCast(array))
  {
    ids->assign(exact->GetPointer(0), exact->GetPointer(0) + count);
  }
  else
  {
    for (vtkIdType i = 0; i < count; ++i)
    {
      ids->push_back(static_cast<vtkIdType>(array->GetComponent(i, 0)));
    }
  }
  this->Ids = std::move(ids);
}

HapticSurface::Snapshot HapticSurface::Transform(const Snapshot& local, std::string& error) const
{
  const double determinant = this->Matrix->Determinant();
  if (!std::isfinite(determinant) || determinant == 0.0)
  {
    error = "the actor's matrix flattens it or is not finite; check its scale and user matrix";
    return nullptr;
  }
  const auto& m = this->Matrix->Element;
  TriangleMesh mesh;
  mesh.Triangles = local->Triangles();
  mesh.Points.reserve(local->Points().size());
  for (const Vec3& p : local->Points())
  {
    const Vec3& o = local->Origin();
    const double x = p[0] + o[0];
    const double y = p[1] + o[1];
    const double z = p[2] + o[2];
    mesh.Points.push_back({ m[0][0] * x + m[0][1] * y + m[0][2] * z + m[0][3],
      m[1][0] * x + m[1][1] * y + m[1][2] * z + m[1][3],
      m[2][0] * x + m[2][1] * y + m[2][2] * z + m[2][3] });
  }
  if (determinant < 0.0) // a mirror turns every front into a back
  {
    for (Triangle& triangle : mesh.Triangles)
    {
      std::swap(triangle[1], triangle[2]);
    }
  }
  double longest = 0.0;
  for (int axis = 0; axis < 3; ++axis)
  {
    longest = std::max(longest, std::hypot(m[0][axis], m[1][axis], m[2][axis]));
  }
  SurfaceOptions options;
  options.TouchedSide = local->TouchedSide();
  options.Engine = local->Engine().Kind();
  // The longest axis bounds how a gap grows up to a factor of sqrt(3).
  options.CrackWidth = this->Preparation->GetCrackWidthInUse() * longest * std::sqrt(3.0);
  return TriangleSurface::Build(std::move(mesh), options, error);
}
}
