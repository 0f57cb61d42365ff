#include "vtkHapticPatchInformation.h"

#include "haptics/Filters/PatchRecord.h"
#include "haptics/Surface/SurfacePatch.h"
#include "vtkCellData.h"
#include "vtkCharArray.h"
#include "vtkClientServerStream.h"
#include "vtkCommunicator.h"
#include "vtkDataArray.h"
#include "vtkDataSetAttributes.h"
#include "vtkFieldData.h"
#include "vtkHapticSurfaceRepresentation.h"
#include "vtkIdTypeArray.h"
#include "vtkMultiProcessController.h"
#include "vtkMultiProcessStream.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkProcessModule.h"
#include "vtkTypeInt64Array.h"

#include <algorithm>

vtkStandardNewMacro(vtkHapticPatchInformation);

namespace
{
/// VTK writes a vtkIdTypeArray in 32 bits, and reads 64 bits as an array of another type.
template <class Array>
void ChangeType(vtkDataSetAttributes* data, const char* name)
{
  vtkDataArray* const ids = data->GetArray(name);
  if (ids)
  {
    vtkNew<Array> changed;
    changed->DeepCopy(ids);
    changed->SetName(name);
    data->RemoveArray(name);
    data->AddArray(changed);
  }
}

template <class Array>
void ChangeTypes(vtkPolyData* part)
{
  ChangeType<Array>(part->GetPointData(), haptics::PatchRecord::PointIds);
  ChangeType<Array>(part->GetCellData(), haptics::PatchRecord::CellIds);
}

vtkClientServerStream::Array AsArray(const std::string& bytes)
{
  return vtkClientServerStream::InsertArray(bytes.data(), static_cast<int>(bytes.size()));
}

bool Take(const vtkClientServerStream* stream, int& place, std::string& bytes)
{
  vtkTypeUInt32 length = 0;
  const bool isArray = stream->GetArgumentLength(0, place, &length) != 0;
  bytes.resize(length);
  return isArray && stream->GetArgument(0, place++, bytes.data(), length) != 0;
}
}

vtkHapticPatchInformation::vtkHapticPatchInformation() = default;
vtkHapticPatchInformation::~vtkHapticPatchInformation() = default;

void vtkHapticPatchInformation::Ask(Question question, const haptics::PatchRegion& region)
{
  std::copy(region.From.begin(), region.From.end(), this->Numbers);
  std::copy(region.To.begin(), region.To.end(), this->Numbers + 3);
  this->Numbers[6] = region.Radius;
  this->Numbers[7] = static_cast<double>(question);
}

haptics::PatchRegion vtkHapticPatchInformation::GetRegion() const
{
  haptics::PatchRegion region;
  std::copy_n(this->Numbers, 3, region.From.begin());
  std::copy_n(this->Numbers + 3, 3, region.To.begin());
  region.Radius = this->Numbers[6];
  return region;
}

void vtkHapticPatchInformation::SetPart(vtkPolyData* part)
{
  if (part->GetNumberOfCells() == 0 && part->GetFieldData()->GetNumberOfArrays() == 0)
  {
    return;
  }
  vtkNew<vtkPolyData> sent;
  sent->ShallowCopy(part);
  ChangeTypes<vtkTypeInt64Array>(sent);
  vtkNew<vtkCharArray> bytes;
  vtkCommunicator::MarshalDataObject(sent, bytes);
  const int process =
    vtkProcessModule::GetProcessModule()->GetGlobalController()->GetLocalProcessId();
  this->Parts[process].assign(
    bytes->GetPointer(0), static_cast<std::size_t>(bytes->GetNumberOfValues()));
}

std::vector<vtkSmartPointer<vtkPolyData>> vtkHapticPatchInformation::GetParts() const
{
  std::vector<vtkSmartPointer<vtkPolyData>> parts;
  for (const auto& [process, bytes] : this->Parts)
  {
    vtkNew<vtkCharArray> buffer;
    buffer->SetArray(const_cast<char*>(bytes.data()), static_cast<vtkIdType>(bytes.size()), 1);
    auto part = vtkSmartPointer<vtkPolyData>::New();
    if (vtkCommunicator::UnMarshalDataObject(buffer, part))
    {
      ChangeTypes<vtkIdTypeArray>(part);
      parts.push_back(part);
    }
  }
  return parts;
}

void vtkHapticPatchInformation::SetHead(
  bool isInPatches, vtkTypeUInt64 version, const std::string& error)
{
  this->HasHead = true;
  this->IsInPatches = isInPatches;
  this->Version = version;
  this->Error = error;
}

void vtkHapticPatchInformation::ClearAnswer()
{
  this->HasHead = false;
  this->Parts.clear();
}

vtkTypeInt64 vtkHapticPatchInformation::GetNumberOfBytes() const
{
  vtkTypeInt64 sum = 0;
  for (const auto& part : this->Parts)
  {
    sum += static_cast<vtkTypeInt64>(part.second.size());
  }
  return sum;
}

void vtkHapticPatchInformation::CopyFromObject(vtkObject* representation)
{
  this->ClearAnswer();
  if (auto* const asked = vtkHapticSurfaceRepresentation::SafeDownCast(representation))
  {
    asked->Answer(this);
  }
}

void vtkHapticPatchInformation::AddInformation(vtkPVInformation* added)
{
  auto* const other = vtkHapticPatchInformation::SafeDownCast(added);
  if (!other)
  {
    return;
  }
  if (!this->HasHead && other->HasHead)
  {
    this->SetHead(other->IsInPatches, other->Version, other->Error);
  }
  this->Parts.insert(other->Parts.begin(), other->Parts.end());
}

void vtkHapticPatchInformation::CopyToStream(vtkClientServerStream* stream)
{
  stream->Reset();
  *stream << vtkClientServerStream::Reply << static_cast<int>(this->HasHead)
          << static_cast<int>(this->IsInPatches) << this->Version << this->Error.c_str()
          << static_cast<int>(this->Parts.size());
  for (const auto& [process, bytes] : this->Parts)
  {
    *stream << process << AsArray(bytes);
  }
  *stream << vtkClientServerStream::End;
}

void vtkHapticPatchInformation::CopyFromStream(const vtkClientServerStream* stream)
{
  int place = 0;
  int hasHead = 0;
  int isInPatches = 0;
  int parts = 0;
  this->Parts.clear();
  bool isGood = stream->GetArgument(0, place++, &hasHead) != 0 &&
    stream->GetArgument(0, place++, &isInPatches) != 0 &&
    stream->GetArgument(0, place++, &this->Version) != 0 &&
    stream->GetArgument(0, place++, &this->Error) != 0 &&
    stream->GetArgument(0, place++, &parts) != 0;
  for (int i = 0; isGood && i < parts; ++i)
  {
    int process = 0;
    isGood =
      stream->GetArgument(0, place++, &process) != 0 && Take(stream, place, this->Parts[process]);
  }
  this->HasHead = isGood && hasHead != 0;
  this->IsInPatches = isInPatches != 0;
  if (!isGood)
  {
    vtkErrorMacro("The server's answer cannot be read. Run client and server of one version.");
  }
}

void vtkHapticPatchInformation::CopyParametersToStream(vtkMultiProcessStream& stream)
{
  for (const double number : this->Numbers)
  {
    stream << number;
  }
}

void vtkHapticPatchInformation::CopyParametersFromStream(vtkMultiProcessStream& stream)
{
  for (double& number : this->Numbers)
  {
    stream >> number;
  }
}

void vtkHapticPatchInformation::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Parts: " << this->Parts.size() << "\n";
  os << indent << "NumberOfBytes: " << this->GetNumberOfBytes() << "\n";
}
