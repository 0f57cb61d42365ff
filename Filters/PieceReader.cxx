#include "haptics/Filters/PieceReader.h"

#include "vtkAlgorithm.h"
#include "vtkAlgorithmOutput.h"
#include "vtkAppendPolyData.h"
#include "vtkDataSet.h"
#include "vtkDemandDrivenPipeline.h"
#include "vtkNew.h"
#include "vtkPartitionedDataSet.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace haptics
{
namespace
{
/// The polydata that a producer gives: itself, or the partitions that are there (vtkHDFReader,
/// since VTK 9.5). Null where that is something else, of the class `kind`.
vtkSmartPointer<vtkPolyData> PolyDataIn(vtkDataObject* given, std::string& kind)
{
  kind = given ? given->GetClassName() : "nothing";
  auto* const partitions = vtkPartitionedDataSet::SafeDownCast(given);
  if (!partitions)
  {
    return vtkPolyData::SafeDownCast(given);
  }
  vtkNew<vtkAppendPolyData> append;
  auto surface = vtkSmartPointer<vtkPolyData>::New();
  for (unsigned int i = 0; i < partitions->GetNumberOfPartitions(); ++i)
  {
    vtkDataSet* const partition = partitions->GetPartition(i);
    if (!partition)
    {
      continue; // of another piece
    }
    surface = vtkPolyData::SafeDownCast(partition);
    if (!surface)
    {
      kind = partition->GetClassName();
      return nullptr;
    }
    append->AddInputData(surface);
  }
  if (append->GetNumberOfInputConnections(0) > 1)
  {
    append->Update();
    surface = append->GetOutput();
  }
  return surface;
}
}

bool PieceReader::Connect(vtkAlgorithmOutput* port)
{
  if (port == this->Port)
  {
    return false;
  }
  this->Producer = port ? port->GetProducer() : nullptr;
  this->Port = port;
  this->ForgetPieces();
  return true;
}

vtkMTimeType PieceReader::PipelineTime() const
{
  if (!this->Producer)
  {
    return 0;
  }
  auto* const pipeline = vtkDemandDrivenPipeline::SafeDownCast(this->Producer->GetExecutive());
  pipeline->UpdatePipelineMTime();
  return pipeline->GetPipelineMTime();
}

vtkMTimeType PieceReader::ProducerTime()
{
  const vtkMTimeType time = this->PipelineTime();
  if (time != this->ReadAt)
  {
    this->ModifiedAt = time;
  }
  return this->ModifiedAt;
}

/// Whether a piece was read. What reading itself modifies is no other surface: VTK 9.6's readers
/// are modified whenever they open a file.
bool PieceReader::UpdatePiece(int piece)
{
  this->ProducerTime();
  const bool isDone = this->Producer->UpdatePiece(piece, this->NumberOfPieces, 0) != 0;
  this->ReadAt = this->PipelineTime();
  return isDone && this->Producer->GetErrorCode() == 0;
}

vtkPolyData* PieceReader::Read(int piece, std::string& error)
{
  const auto place = std::find_if(this->Kept.begin(), this->Kept.end(),
    [piece](const KeptPiece& kept) { return kept.Number == piece; });
  if (place != this->Kept.end())
  {
    this->Kept.splice(this->Kept.begin(), this->Kept, place);
    return this->Kept.front().Data;
  }
  while (static_cast<int>(this->Kept.size()) >= this->PiecesInMemory)
  {
    this->Kept.pop_back();
  }
  ++this->Reads;
  const bool isDone = this->UpdatePiece(piece);
  vtkDataObject* const given = this->Producer->GetOutputDataObject(this->Port->GetIndex());
  std::string kind;
  const vtkSmartPointer<vtkPolyData> surface = PolyDataIn(given, kind);
  if (!isDone || !surface)
  {
    error = "Piece " + std::to_string(piece) + " of " + std::to_string(this->NumberOfPieces) +
      " cannot be read: " + this->Producer->GetClassName() + " gives " +
      (surface ? "an error" : kind) +
      ". Connect what gives polydata in pieces, such as a vtkXMLPPolyDataReader, and see what it "
      "reports.";
    return nullptr;
  }
  KeptPiece fresh{ piece, vtkSmartPointer<vtkPolyData>::New() };
  fresh.Data->ShallowCopy(surface);
  // Or it would stay in memory while the next one is read. A trivial producer would have nothing to
  // give any more, nor would a vtkHDFReader that keeps its partitions.
  if (surface == given && !this->Producer->IsA("vtkTrivialProducer"))
  {
    given->ReleaseData();
  }
  // A vtkXMLPPolyDataReader keeps each piece that it has read until it opens the file anew.
  if (this->Producer->IsA("vtkXMLPDataReader"))
  {
    this->Producer->Modified();
    this->ReadAt = this->PipelineTime();
  }
  this->Kept.push_front(fresh);
  return this->Kept.front().Data;
}

std::vector<int> PieceReader::PiecesNear(const PatchRegion& region) const
{
  std::vector<int> near;
  for (std::size_t i = 0; i < this->Boxes.size(); ++i)
  {
    const PartBox& box = this->Boxes[i];
    if (!box.IsEmpty() && region.MeetsBox(box.Low, box.High))
    {
      near.push_back(static_cast<int>(i));
    }
  }
  return near;
}

bool PieceReader::Has(const std::vector<int>& pieces) const
{
  return std::all_of(pieces.begin(), pieces.end(),
    [this](int piece)
    {
      return std::any_of(this->Kept.begin(), this->Kept.end(),
        [piece](const KeptPiece& kept) { return kept.Number == piece; });
    });
}

bool PieceReader::Crop(const PatchRegion& region, Parts& parts, std::string& error)
{
  for (const int i : this->PiecesNear(region))
  {
    vtkPolyData* const piece = this->Read(i, error);
    if (!piece)
    {
      return false;
    }
    parts.push_back(CropPart(piece, region, this->Offsets[static_cast<std::size_t>(i)]));
  }
  return true;
}

/// Reads the nearest piece first, and no more than may have something nearer than what was found.
bool PieceReader::CropNearest(const Vec3& place, Parts& parts, std::string& error)
{
  std::vector<std::pair<double, int>> pieces;
  for (std::size_t i = 0; i < this->Boxes.size(); ++i)
  {
    if (!this->Boxes[i].IsEmpty())
    {
      pieces.emplace_back(this->Boxes[i].DistanceTo(place), static_cast<int>(i));
    }
  }
  std::sort(pieces.begin(), pieces.end());
  double nearest = HUGE_VAL;
  for (const auto& [distance, i] : pieces)
  {
    if (distance >= nearest)
    {
      break;
    }
    vtkPolyData* const piece = this->Read(i, error);
    if (!piece)
    {
      return false;
    }
    parts.push_back(haptics::CropNearest(piece, place, nearest));
  }
  return true;
}
}
