#include "vtkGodObjectTrace.h"

#include "haptics/Filters/ErrorText.h"
#include "haptics/Filters/LengthUnit.h"
#include "haptics/Filters/NumberSetting.h"
#include "haptics/Filters/PatchRecord.h"
#include "haptics/Filters/TouchedArrays.h"
#include "haptics/Filters/TraceCSV.h"
#include "haptics/Filters/TraceRecorder.h"
#include "vtkGodObjectFilter.h"
#include "vtkHapticPatchAlgorithm.h"
#include "vtkHapticProperties.h"

#include "haptics/Contact/GodObject.h"
#include "haptics/Tick/ContactTick.h"
#include "haptics/Tick/SurfaceForce.h"

#include "vtkAlgorithmOutput.h"
#include "vtkBoundingBox.h"
#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkCommand.h"
#include "vtkDataArray.h"
#include "vtkIdList.h"
#include "vtkIdTypeArray.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMath.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>
#include <utility>

namespace
{
constexpr vtkIdType TicksPerProgress = 1024;

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

void vtkGodObjectTrace::SetUnitLength(double metres)
{
  haptics::SetLength(this, "UnitLength", this->UnitLength, metres);
}

void vtkGodObjectTrace::SetWorldToDeviceScale(double metres)
{
  haptics::SetLength(this, "WorldToDeviceScale", this->WorldToDeviceScale, metres);
}

double vtkGodObjectTrace::ScaleInUse() const
{
  return this->WorldToDeviceScale > 0.0 ? this->WorldToDeviceScale
    : this->UnitLength > 0.0            ? this->UnitLength
                                        : 1.0;
}

bool vtkGodObjectTrace::WriteCSV(const char* file)
{
  vtkPolyData* const output = this->GetOutput();
  const std::string error = output->GetPointData()->GetNumberOfArrays() == 0
    ? "There is no trace to write yet. Call Update() first, and see what it reports."
    : haptics::WriteTraceCSV(output, file);
  if (!error.empty())
  {
    vtkErrorMacro(<< error);
  }
  return error.empty();
}

/// Of a surface that nobody has given a scale: what is in millimetres is taken for metres.
void vtkGodObjectTrace::WarnOfSize(double size)
{
  constexpr double largest = 2.0;
  constexpr double smallest = 1e-3;
  constexpr double reach = 0.1; // [m] of a common desktop device
  const double inHand = size * this->ScaleInUse();
  const bool isOdd =
    this->WorldToDeviceScale == 0.0 && size > 0.0 && !(inHand >= smallest && inHand <= largest);
  if (isOdd && !this->HasWarnedOfSize)
  {
    std::ostringstream text;
    text.precision(3);
    text << "The surface is " << size << " world units across, which are " << inHand
         << " m in the hand, and devices reach some " << reach << " m. ";
    if (this->UnitLength == 0.0)
    {
      text << "Give the length of a world unit where that is not 1 m, SetUnitLength(0.001) for "
              "millimetres, or the metres in the hand for one, ";
    }
    else
    {
      text << "Give the metres in the hand for one world unit, ";
    }
    text << "SetWorldToDeviceScale(" << reach / size << ") for a surface as large as the reach.";
    vtkWarningMacro(<< text.str());
  }
  this->HasWarnedOfSize = isOdd;
}

void vtkGodObjectTrace::SetTipRadius(double radius)
{
  if (!(radius >= 0.0) || !std::isfinite(radius))
  {
    vtkErrorMacro("The radius of the tip must be finite and not below 0 m, but is "
      << radius << "; it stays " << this->TipRadius << " m.");
    return;
  }
  if (this->TipRadius != radius)
  {
    this->TipRadius = radius;
    this->Modified();
  }
}

bool vtkGodObjectTrace::CheckTip(vtkGodObjectFilter* prepared)
{
  const double size =
    prepared->GetSurface() ? prepared->GetSurface()->Diagonal() * this->ScaleInUse() : 0.0;
  if (size > 0.0 && this->TipRadius > 0.5 * size)
  {
    vtkErrorMacro("A tip with a radius of "
      << this->TipRadius << " m is larger than the surface, which has a size of " << size
      << " m in the hand. Give SetTipRadius() at most " << 0.5 * size
      << " m, or SetWorldToDeviceScale() the metres in the hand for one world unit.");
    return false;
  }
  return true;
}

void vtkGodObjectTrace::SetTickPeriod(double value)
{
  haptics::SetNumber(this, "TickPeriod", this->TickPeriod, value, 1e-6, 1.0);
}

void vtkGodObjectTrace::AddSurfaceArray(const char* name)
{
  if (name && *name)
  {
    this->SurfaceArrays.emplace_back(name);
    this->Modified();
  }
}

void vtkGodObjectTrace::ClearSurfaceArrays()
{
  if (!this->SurfaceArrays.empty())
  {
    this->SurfaceArrays.clear();
    this->Modified();
  }
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
  vtkGodObjectFilter* upstream = this->Source ? nullptr : FindPreparation(this, 1);
  this->SurfaceError.clear();
  if (upstream && upstream->GetSurface() &&
    upstream->GetOutput()->GetPoints() == surface->GetPoints() &&
    upstream->GetOutput()->GetNumberOfPolys() == surface->GetNumberOfPolys())
  {
    return upstream;
  }
  // Only points and cells where no property reads more: the filter inside must not copy data that
  // nobody will look at.
  bool needsData = this->PassSurfaceArrays || this->GetProperties()->GetTextureImage() != nullptr;
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
    geometry->GetCellData()->AddArray(
      surface->GetCellData()->GetArray(haptics::PatchRecord::CellIds));
    geometry->GetPointData()->AddArray(
      surface->GetPointData()->GetArray(haptics::PatchRecord::PointIds));
    geometry->SetFieldData(surface->GetFieldData());
  }
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
  this->Source = vtkHapticPatchAlgorithm::SafeDownCast(this->GetInputAlgorithm(1, 0));
  if (this->Source)
  {
    vtkHapticPatchAlgorithm* const source = this->Source;
    double first[3];
    path->GetPoint(0, first);
    if (this->LoadPatch(first, first))
    {
      double bounds[6];
      source->GetSurfaceBounds(bounds);
      this->WarnOfSize(vtkBoundingBox(bounds).GetMaxLength());
      if (this->CheckTip(this->Preparation))
      {
        this->Replay(path, this->Preparation, output);
      }
    }
    this->Source = nullptr;
    return 1;
  }
  vtkGodObjectFilter* const upstream = FindPreparation(this, 1);
  if (upstream && !upstream->GetSurface() &&
    !vtkGodObjectFilter::IsEmpty(vtkPolyData::SafeDownCast(upstream->GetInput())))
  {
    vtkErrorMacro("The surface at port 1 cannot be touched: the vtkGodObjectFilter before it has "
                  "made none. Mend what that filter reports.");
    return 1;
  }
  vtkGodObjectFilter* prepared = this->PrepareSurface(surface);
  if (!prepared->GetSurface() && !vtkGodObjectFilter::IsEmpty(surface))
  {
    vtkErrorMacro(<< "The surface at port 1 cannot be touched. " << this->SurfaceError);
    return 1;
  }
  if (prepared == this->Preparation && !this->SurfaceError.empty())
  {
    vtkErrorMacro(<< "The surface at port 1: " << this->SurfaceError);
  }
  vtkPolyData* const touched = prepared->GetOutput();
  this->WarnOfSize(
    touched->GetNumberOfCells() > 0 ? vtkBoundingBox(touched->GetBounds()).GetMaxLength() : 0.0);
  if (!this->CheckTip(prepared))
  {
    return 1;
  }
  this->Replay(path, prepared, output);
  return 1;
}

std::unique_ptr<haptics::GodObject> vtkGodObjectTrace::MakeGodObject(vtkGodObjectFilter* prepared)
{
  std::vector<haptics::TouchedSurface> surfaces;
  if (prepared->GetSurface())
  {
    surfaces.push_back({ prepared->GetSurface(), nullptr, prepared->GetSurfaceProperties() });
    surfaces.back().Identity = 1;
  }
  auto god = std::make_unique<haptics::GodObject>(
    std::move(surfaces), this->TipRadius > 0.0 ? haptics::Tip::Ball : haptics::Tip::Point);
  god->SetSubstepLimit(this->SubstepLimit);
  god->SetTipRadius(this->TipRadius / this->ScaleInUse());
  return god;
}

/// Prepares what is near a god-object and its HIP. False, and an error, where that fails.
bool vtkGodObjectTrace::LoadPatch(const double position[3], const double hip[3])
{
  vtkNew<vtkPolyData> patch;
  if (!this->Source->Survey())
  {
    return false;
  }
  const double lag = std::sqrt(vtkMath::Distance2BetweenPoints(position, hip));
  haptics::PatchRegion region;
  std::copy_n(position, 3, region.From.begin());
  std::copy_n(hip, 3, region.To.begin());
  region.Radius = this->Source->GetPatchRadiusInUse() + lag + this->TipRadius / this->ScaleInUse();
  if (!this->Source->MakePatch(region, patch))
  {
    return false;
  }
  vtkGodObjectFilter* const prepared = this->PrepareSurface(patch);
  if (!prepared->GetSurface())
  {
    vtkErrorMacro(<< "The surface at port 1 cannot be touched. " << this->SurfaceError);
    return false;
  }
  if (!this->SurfaceError.empty())
  {
    vtkErrorMacro(<< "The surface at port 1: " << this->SurfaceError);
  }
  return true;
}

/// Where the surface comes in patches: another one, where the HIP is about to leave the last. False
/// where that fails.
bool vtkGodObjectTrace::FollowWithPatch(
  const double hip[3], std::unique_ptr<haptics::GodObject>& god)
{
  const haptics::SurfacePatch* const patch =
    this->Source ? this->Preparation->GetSurface()->Patch() : nullptr;
  if (!patch)
  {
    return true;
  }
  const haptics::Vec3& origin = patch->Whole().Origin;
  const haptics::Vec3 here = god->Current().Position;
  const haptics::Vec3 local{ hip[0] - origin[0], hip[1] - origin[1], hip[2] - origin[2] };
  const double lag = std::sqrt(vtkMath::Distance2BetweenPoints(here.data(), hip));
  const double left = patch->Region().Radius - patch->Region().DistanceTo(local) - lag -
    this->TipRadius / this->ScaleInUse();
  if (left > 0.5 * this->Source->GetPatchRadiusInUse())
  {
    return true;
  }
  if (!this->LoadPatch(here.data(), hip))
  {
    return false;
  }
  auto next = this->MakeGodObject(this->Preparation);
  next->Continue(*god);
  god = std::move(next);
  return true;
}

void vtkGodObjectTrace::Replay(vtkPolyData* path, vtkGodObjectFilter* prepared, vtkPolyData* output)
{
  const vtkIdType ticks = path->GetNumberOfPoints();
  vtkIdTypeArray* originalCells = nullptr;
  vtkIdTypeArray* originalPoints = nullptr;
  const auto findIds = [&]
  {
    originalCells = vtkIdTypeArray::SafeDownCast(
      prepared->GetOutput()->GetCellData()->GetAbstractArray("OriginalCellId"));
    originalPoints = vtkIdTypeArray::SafeDownCast(
      prepared->GetOutput()->GetPointData()->GetAbstractArray("OriginalPointId"));
  };
  findIds();
  vtkNew<vtkIdList> corners;
  std::unique_ptr<haptics::GodObject> godObject = this->MakeGodObject(prepared);
  haptics::WorkspaceTransform deviceToWorld;
  deviceToWorld.Scale = 1.0 / this->ScaleInUse();
  haptics::ContactTick tick;
  haptics::SurfaceForce law;
  haptics::MaterialLimits limits;
  limits.MaximumForce = this->MaximumForce;
  haptics::TickRecord record;
  haptics::TraceRecorder recorder;
  recorder.Reserve(ticks);
  std::optional<haptics::TouchedArrays> touched;
  if (this->PassSurfaceArrays)
  {
    touched.emplace(prepared->GetOutput(), this->SurfaceArrays, ticks);
    const bool isEmpty = !prepared->GetSurface(); // then it may have lost its arrays as well
    for (const std::string& name : isEmpty ? std::vector<std::string>() : touched->Missing())
    {
      vtkWarningMacro(<< "The surface has no array " << name << " for the trace.");
    }
  }
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
    const haptics::GodObject* const before = godObject.get();
    if (i > 0 && !this->FollowWithPatch(hip.data(), godObject)) // it is placed by the first HIP
    {
      return;
    }
    if (godObject.get() != before)
    {
      findIds();
      if (touched && !touched->Continue(prepared->GetOutput()))
      {
        vtkErrorMacro("The surface at port 1 has other data arrays in one piece than in another. "
                      "Give all pieces the same, or call PassSurfaceArraysOff().");
        return;
      }
    }
    const haptics::Contact& contact =
      tick.Touch(*godObject, deviceToWorld.VectorToDevice(hip), hip, deviceToWorld);
    const haptics::Vec3 force = law.Update(contact, this->TickPeriod, this->Stiffness, limits);
    record.Time = static_cast<double>(i) * this->TickPeriod;
    tick.Record(*godObject, force, law, record);
    heldTicks += record.Status == haptics::UpdateStatus::Overloaded ? 1 : 0;
    refusedTicks += record.Status == haptics::UpdateStatus::InvalidHip ? 1 : 0;
    const bool isHeld = record.NumberOfConstraints > 0;
    if (touched)
    {
      touched->Add(i, isHeld ? record.Constraints[0].Triangle : -1, record.Weights);
    }
    haptics::TracePlace place;
    if (isHeld)
    {
      const vtkIdType triangle = record.Constraints[0].Triangle;
      prepared->GetOutput()->GetPolys()->GetCellAtId(triangle, corners);
      place = { 0, originalCells->GetValue(triangle), {}, record.Weights };
      for (std::size_t k = 0; k < 3; ++k)
      {
        place.Points[k] = static_cast<std::int32_t>(
          originalPoints->GetValue(corners->GetId(static_cast<vtkIdType>(k))));
      }
    }
    recorder.Add({ record, place });
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

  recorder.Write(output, this->UnitLength);
  vtkNew<vtkPointData> found;
  found->ShallowCopy(output->GetPointData());
  if (path->GetPointData()->HasArray("Time"))
  {
    found->RemoveArray("Time");
  }
  output->GetPointData()->PassData(path->GetPointData());
  for (int i = 0; i < found->GetNumberOfArrays(); ++i)
  {
    output->GetPointData()->AddArray(found->GetAbstractArray(i));
  }
  if (touched)
  {
    touched->AddTo(output->GetPointData());
  }
  this->UpdateProgress(1.0);
}

void vtkGodObjectTrace::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Stiffness: " << this->Stiffness << " N/m\n";
  os << indent << "MaximumForce: " << this->MaximumForce << " N\n";
  os << indent << "UnitLength: " << this->UnitLength << " m\n";
  os << indent << "WorldToDeviceScale: " << this->WorldToDeviceScale << " m\n";
  os << indent << "TickPeriod: " << this->TickPeriod << " s\n";
  os << indent << "SubstepLimit: " << this->SubstepLimit << "\n";
  os << indent << "TipRadius: " << this->TipRadius << " m\n";
  os << indent << "PassSurfaceArrays: " << (this->PassSurfaceArrays ? "On" : "Off");
  for (const std::string& name : this->SurfaceArrays)
  {
    os << " " << name;
  }
  os << "\n" << indent << "Preparation:\n";
  this->Preparation->PrintSelf(os, indent.GetNextIndent());
}
