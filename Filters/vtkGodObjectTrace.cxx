#include "vtkGodObjectTrace.h"

#include "ErrorText.h"
#include "NumberSetting.h"
#include "vtkGodObjectFilter.h"
#include "vtkHapticProperties.h"

#include "ForceModel.h"
#include "GodObject.h"
#include "SurfaceForce.h"

#include "vtkAlgorithmOutput.h"
#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkCommand.h"
#include "vtkDataArray.h"
#include "vtkDoubleArray.h"
#include "vtkIdTypeArray.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include <algorithm>
#include <cmath>

namespace
{
constexpr vtkIdType TicksPerProgress = 1024;

template <typename Array>
vtkSmartPointer<Array> NewArray(const char* name, int components, vtkIdType tuples)
{
  auto array = vtkSmartPointer<Array>::New();
  array->SetName(name);
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(tuples);
  return array;
}

/// The constraint that pushes most against the HIP, of those of a touching contact.
const haptics::Constraint& StrongestConstraint(const haptics::Contact& contact)
{
  const auto push = [&contact](const haptics::Constraint& constraint)
  {
    const haptics::Vec3& n = constraint.Normal;
    const haptics::Vec3& d = contact.Displacement;
    return n[0] * d[0] + n[1] * d[1] + n[2] * d[2];
  };
  return *std::max_element(contact.Constraints.begin(),
    contact.Constraints.begin() + contact.NumberOfConstraints,
    [&push](const haptics::Constraint& a, const haptics::Constraint& b)
    { return push(a) < push(b); });
}

haptics::Vec3 Scaled(const haptics::Vec3& v, double scale)
{
  return { scale * v[0], scale * v[1], scale * v[2] };
}

/// What a hand that went from the last HIP to this one has put in against a force [J].
double Work(const haptics::Vec3& force, const haptics::Vec3& from, const haptics::Vec3& to)
{
  return -force[0] * (to[0] - from[0]) - force[1] * (to[1] - from[1]) -
    force[2] * (to[2] - from[2]);
}

/// The vtkGodObjectFilter whose output reaches the port unchanged, or null. ParaView puts a
/// vtkPVPostFilter, which passes points and cells on, behind every filter. One that has several
/// blocks remembers only the last.
vtkGodObjectFilter* FindPreparation(vtkAlgorithm* consumer, int port)
{
  vtkAlgorithm* producer = consumer->GetInputAlgorithm(port, 0);
  while (
    producer && producer->IsA("vtkPVPostFilter") && producer->GetNumberOfInputConnections(0) > 0)
  {
    producer = producer->GetInputAlgorithm(0, 0);
  }
  vtkGodObjectFilter* filter = vtkGodObjectFilter::SafeDownCast(producer);
  return filter && vtkPolyData::SafeDownCast(filter->GetInputDataObject(0, 0)) ? filter : nullptr;
}
}

vtkStandardNewMacro(vtkGodObjectTrace);

vtkGodObjectTrace::vtkGodObjectTrace()
{
  this->SetNumberOfInputPorts(2);
  this->Preparation->AddObserver(
    vtkCommand::ErrorEvent, this, &vtkGodObjectTrace::KeepSurfaceError);
}

vtkGodObjectTrace::~vtkGodObjectTrace() = default;

void vtkGodObjectTrace::SetStiffness(double value)
{
  haptics::SetNumber(this, "Stiffness", this->Stiffness, value, 0.0, 1e100);
}

void vtkGodObjectTrace::SetMaximumForce(double value)
{
  haptics::SetNumber(this, "MaximumForce", this->MaximumForce, value, 0.0, 1e100);
}

void vtkGodObjectTrace::SetWorldToDeviceScale(double value)
{
  haptics::SetNumber(this, "WorldToDeviceScale", this->WorldToDeviceScale, value, 1e-100, 1e100);
}

void vtkGodObjectTrace::SetTickPeriod(double value)
{
  haptics::SetNumber(this, "TickPeriod", this->TickPeriod, value, 1e-6, 1.0);
}

int vtkGodObjectTrace::FillInputPortInformation(int port, vtkInformation* info)
{
  // Optional, so that RequestData can say which one is missing, and for what.
  info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
  return this->Superclass::FillInputPortInformation(port, info);
}

void vtkGodObjectTrace::SetSurfaceConnection(vtkAlgorithmOutput* surface)
{
  this->SetInputConnection(1, surface);
}

void vtkGodObjectTrace::SetSurfaceData(vtkPolyData* surface)
{
  this->SetInputData(1, surface);
}

vtkHapticProperties* vtkGodObjectTrace::GetProperties()
{
  return this->Preparation->GetProperties();
}

vtkMTimeType vtkGodObjectTrace::GetMTime()
{
  return std::max(this->Superclass::GetMTime(), this->GetProperties()->GetMTime());
}

void vtkGodObjectTrace::SetSide(int side)
{
  const int before = this->GetSide();
  this->Preparation->SetSide(side);
  if (this->GetSide() != before)
  {
    this->Modified();
  }
}

int vtkGodObjectTrace::GetSide() const
{
  return this->Preparation->GetSide();
}

void vtkGodObjectTrace::SetEngine(int engine)
{
  const int before = this->GetEngine();
  this->Preparation->SetEngine(engine);
  if (this->GetEngine() != before)
  {
    this->Modified();
  }
}

int vtkGodObjectTrace::GetEngine() const
{
  return this->Preparation->GetEngine();
}

void vtkGodObjectTrace::KeepSurfaceError(vtkObject*, unsigned long, void* text)
{
  haptics::AppendErrorText(this->SurfaceError, static_cast<const char*>(text));
}

vtkGodObjectFilter* vtkGodObjectTrace::PrepareSurface(vtkPolyData* surface)
{
  vtkGodObjectFilter* upstream = FindPreparation(this, 1);
  if (upstream && upstream->GetSurface() &&
    upstream->GetOutput()->GetPoints() == surface->GetPoints() &&
    upstream->GetOutput()->GetNumberOfPolys() == surface->GetNumberOfPolys())
  {
    return upstream;
  }
  // Only points and cells where no property reads more: the filter inside must not copy data that
  // nobody will look at.
  bool needsData = this->GetProperties()->GetTextureImage() != nullptr;
  for (int i = 0; i <= vtkGodObjectFilter::SIDE_ARRAY; ++i) // the properties' arrays come first
  {
    vtkInformation* const chosen = this->GetInputArrayInformation(i);
    this->Preparation->GetInputArrayInformation(i)->Copy(chosen);
    needsData = needsData || chosen->Has(vtkDataObject::FIELD_ASSOCIATION());
  }
  vtkNew<vtkPolyData> geometry;
  if (needsData)
  {
    geometry->ShallowCopy(surface);
  }
  else
  {
    geometry->CopyStructure(surface);
    geometry->GetCellData()->AddArray(surface->GetCellGhostArray());
  }
  this->SurfaceError.clear();
  this->Preparation->SetInputData(geometry);
  this->Preparation->Update();
  return this->Preparation;
}

bool vtkGodObjectTrace::CheckPath(vtkPolyData* path)
{
  if (!path || path->GetNumberOfPoints() == 0)
  {
    vtkErrorMacro("There is no path to follow: port 0 has no points. Give it a vtkPolyData whose "
                  "points are the positions of the haptic interface point, in order.");
    return false;
  }
  for (vtkIdType i = 0; i < path->GetNumberOfPoints(); ++i)
  {
    double hip[3];
    path->GetPoint(i, hip);
    if (!std::isfinite(hip[0]) || !std::isfinite(hip[1]) || !std::isfinite(hip[2]))
    {
      vtkErrorMacro("Point " << i << " of the path is (" << hip[0] << ", " << hip[1] << ", "
                             << hip[2] << "), the first that is not finite. Remove it, or mend "
                             << "the source of port 0.");
      return false;
    }
  }
  return true;
}

int vtkGodObjectTrace::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkPolyData* path = vtkPolyData::GetData(inputVector[0]);
  vtkPolyData* surface = vtkPolyData::GetData(inputVector[1]);
  vtkPolyData* output = vtkPolyData::GetData(outputVector);
  if (!this->CheckPath(path))
  {
    return 1;
  }
  if (!surface)
  {
    vtkErrorMacro("There is no surface to touch: port 1 has no input. Connect a vtkPolyData with "
                  "polygons or strips.");
    return 1;
  }
  vtkGodObjectFilter* prepared = this->PrepareSurface(surface);
  if (!prepared->GetSurface())
  {
    vtkErrorMacro(<< "The surface at port 1 cannot be touched. " << this->SurfaceError);
    return 1;
  }
  if (prepared == this->Preparation && !this->SurfaceError.empty())
  {
    vtkErrorMacro(<< "The surface at port 1: " << this->SurfaceError);
  }
  this->Replay(path, prepared, output);
  return 1;
}

void vtkGodObjectTrace::Replay(vtkPolyData* path, vtkGodObjectFilter* prepared, vtkPolyData* output)
{
  const vtkIdType ticks = path->GetNumberOfPoints();
  auto positions = NewArray<vtkDoubleArray>("Points", 3, ticks);
  auto hips = NewArray<vtkDoubleArray>("HapticInterfacePoint", 3, ticks);
  auto forces = NewArray<vtkDoubleArray>("Force", 3, ticks);
  auto constraints = NewArray<vtkIntArray>("ActiveConstraints", 1, ticks);
  auto cells = NewArray<vtkIdTypeArray>("OriginalCellId", 1, ticks);
  auto penetrations = NewArray<vtkDoubleArray>("Penetration", 1, ticks);
  vtkIdTypeArray* originalCells = vtkIdTypeArray::SafeDownCast(
    prepared->GetOutput()->GetCellData()->GetAbstractArray("OriginalCellId"));

  auto stiffnesses = NewArray<vtkDoubleArray>("Stiffness", 1, ticks);
  auto energies = NewArray<vtkDoubleArray>("Energy", 1, ticks);
  auto tanks = NewArray<vtkDoubleArray>("EnergyTank", 1, ticks);

  haptics::GodObject godObject(
    { { prepared->GetSurface(), nullptr, prepared->GetSurfaceProperties() } });
  haptics::SurfaceForce surfaceForce;
  haptics::FeelLimits limits;
  limits.MaximumForce = this->MaximumForce;
  double energy = 0.0;
  haptics::Vec3 lastHip{};
  haptics::Vec3 force{};
  haptics::ForceModel model;
  model.Stiffness = this->Stiffness;
  model.MaximumForce = this->MaximumForce;
  vtkIdType heldTicks = 0;
  vtkIdType refusedTicks = 0;
  for (vtkIdType i = 0; i < ticks; ++i)
  {
    if (i % TicksPerProgress == 0)
    {
      this->UpdateProgress(static_cast<double>(i) / static_cast<double>(ticks));
      if (this->GetAbortExecute())
      {
        return;
      }
    }
    haptics::Vec3 hip;
    path->GetPoint(i, hip.data());
    const haptics::Contact& contact = godObject.Update(hip);
    heldTicks += contact.Status == haptics::UpdateStatus::Overloaded ? 1 : 0;
    refusedTicks += contact.Status == haptics::UpdateStatus::InvalidHip ? 1 : 0;
    haptics::FeltContact felt;
    felt.Position = Scaled(hip, this->WorldToDeviceScale);
    felt.Displacement = Scaled(contact.Displacement, this->WorldToDeviceScale);
    energy += i > 0 ? Work(force, lastHip, felt.Position) : 0.0;
    lastHip = felt.Position;
    double stiffness = this->Stiffness;
    if (contact.Felt.IsPlain)
    {
      force = model.Force(felt.Displacement);
    }
    else
    {
      felt.Shaded = Scaled(contact.Shaded, this->WorldToDeviceScale);
      felt.Period = this->TickPeriod;
      felt.IsTouching =
        contact.NumberOfConstraints > 0 || contact.Status == haptics::UpdateStatus::Overloaded;
      felt.Felt = contact.Felt;
      force = surfaceForce.Update(felt, this->Stiffness, limits);
      stiffness = felt.IsTouching ? surfaceForce.GetStiffness() : this->Stiffness;
    }
    positions->SetTypedTuple(i, contact.Position.data());
    hips->SetTypedTuple(i, hip.data());
    forces->SetTypedTuple(i, force.data());
    stiffnesses->SetValue(i, stiffness);
    energies->SetValue(i, energy);
    tanks->SetValue(i, surfaceForce.GetTank());
    constraints->SetValue(i, contact.NumberOfConstraints);
    cells->SetValue(i,
      contact.NumberOfConstraints > 0
        ? originalCells->GetValue(StrongestConstraint(contact).Triangle)
        : -1);
    penetrations->SetValue(i, contact.Penetration);
  }
  if (heldTicks > 0)
  {
    vtkWarningMacro(<< heldTicks << " of " << ticks
                    << " ticks met more triangles in one place than "
                    << "a tick may look at; the god-object waited there.");
  }
  if (refusedTicks > 0)
  {
    vtkWarningMacro(<< refusedTicks << " of " << ticks << " positions of the path are too far from "
                    << "the surface to be followed; the god-object waited.");
  }

  vtkNew<vtkPoints> points;
  points->SetData(positions);
  vtkNew<vtkCellArray> line;
  line->InsertNextCell(static_cast<int>(ticks));
  for (vtkIdType i = 0; i < ticks; ++i)
  {
    line->InsertCellPoint(i);
  }
  output->SetPoints(points);
  if (ticks > 1)
  {
    output->SetLines(line);
  }
  else
  {
    output->SetVerts(line);
  }
  vtkPointData* data = output->GetPointData();
  data->PassData(path->GetPointData());
  data->AddArray(hips);
  data->AddArray(forces);
  data->AddArray(constraints);
  data->AddArray(cells);
  data->AddArray(penetrations);
  data->AddArray(stiffnesses);
  data->AddArray(energies);
  data->AddArray(tanks);
  this->UpdateProgress(1.0);
}

void vtkGodObjectTrace::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Stiffness: " << this->Stiffness << " N/m\n";
  os << indent << "MaximumForce: " << this->MaximumForce << " N\n";
  os << indent << "WorldToDeviceScale: " << this->WorldToDeviceScale << " m\n";
  os << indent << "TickPeriod: " << this->TickPeriod << " s\n";
  os << indent << "Preparation:\n";
  this->Preparation->PrintSelf(os, indent.GetNextIndent());
}
