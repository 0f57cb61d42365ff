#include "vtkHapticPatchSource.h"

#include "haptics/Filters/PatchCropper.h"
#include "haptics/Filters/PatchRecord.h"
#include "haptics/Filters/PieceReader.h"
#include "haptics/Filters/SurfaceCensus.h"
#include "haptics/Filters/SurfaceCleaner.h"

#include "vtkAlgorithmOutput.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include <algorithm>
#include <chrono>
#include <future>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace
{
bool AreSame(const haptics::PatchRegion& a, const haptics::PatchRegion& b)
{
  return a.From == b.From && a.To == b.To && a.Radius == b.Radius;
}
}

class vtkHapticPatchSource::Internals
{
public:
  /// What is near a region, or why it is not known.
  struct Cropping
  {
    haptics::PatchRegion Region;
    haptics::PieceReader::Parts Parts;
    std::string Error;
    bool IsDone = false;
  };

  haptics::PieceReader Reader; ///< of the thread of Reading, while there is one
  std::future<Cropping> Reading;
  std::optional<Cropping> Fetched; ///< what that has got, and nobody has taken yet

  bool IsReading() const
  {
    return this->Reading.valid() &&
      this->Reading.wait_for(std::chrono::seconds(0)) != std::future_status::ready;
  }
  /// Waits for the thread; from here on the reader is the caller's.
  haptics::PieceReader& FreeReader()
  {
    if (this->Reading.valid())
    {
      this->Fetched = this->Reading.get();
    }
    return this->Reader;
  }
  /// When the producer was modified; not while it is in the thread's hands.
  vtkMTimeType ProducerTime()
  {
    this->LastTime = this->IsReading() ? this->LastTime : this->FreeReader().ProducerTime();
    return this->LastTime;
  }

  bool IsSurveyed = false;
  vtkMTimeType SurveyedAt = 0; ///< the producer's pipeline, then
  int SurveyedPieces = 0;

private:
  vtkMTimeType LastTime = 0;
};

vtkStandardNewMacro(vtkHapticPatchSource);

vtkHapticPatchSource::vtkHapticPatchSource()
  : Internal(new Internals)
{
}

vtkHapticPatchSource::~vtkHapticPatchSource() = default;

void vtkHapticPatchSource::SetSurfaceConnection(vtkAlgorithmOutput* pieces)
{
  if (this->Internal->FreeReader().Connect(pieces))
  {
    this->Internal->IsSurveyed = false;
    this->Modified();
  }
}

void vtkHapticPatchSource::SetPiecesInMemory(int pieces)
{
  this->Internal->FreeReader().PiecesInMemory = std::max(1, pieces); // the output is the same
}

int vtkHapticPatchSource::GetPiecesInMemory() const
{
  return this->Internal->FreeReader().PiecesInMemory;
}

vtkIdType vtkHapticPatchSource::GetNumberOfReads()
{
  return this->Internal->FreeReader().NumberOfReads();
}

vtkMTimeType vtkHapticPatchSource::GetMTime()
{
  const vtkMTimeType time = this->Superclass::GetMTime();
  return std::max(time, this->Internal->ProducerTime());
}

bool vtkHapticPatchSource::IsReading() const
{
  return this->Internal->IsReading();
}

void vtkHapticPatchSource::FinishReading()
{
  this->Internal->FreeReader();
}

bool vtkHapticPatchSource::Fetch(const haptics::PatchRegion& region)
{
  Internals& in = *this->Internal;
  if (in.IsReading())
  {
    return false; // what was asked for before: a piece cannot be read by halves
  }
  haptics::PieceReader& reader = in.FreeReader();
  if (!this->ReadInBackground || !this->HasWhole() || reader.Has(reader.PiecesNear(region)) ||
    (in.Fetched && AreSame(in.Fetched->Region, region)))
  {
    return true;
  }
  in.Reading = std::async(std::launch::async,
    [&reader, region]
    {
      Internals::Cropping cropping;
      cropping.Region = region;
      cropping.IsDone = reader.Crop(region, cropping.Parts, cropping.Error);
      return cropping;
    });
  return false;
}

bool vtkHapticPatchSource::Survey()
{
  Internals& in = *this->Internal;
  const vtkMTimeType time = in.ProducerTime();
  if (in.IsSurveyed && in.SurveyedAt == time && in.SurveyedPieces == this->NumberOfPieces)
  {
    return true;
  }
  haptics::PieceReader& reader = in.FreeReader();
  in.Fetched.reset();
  if (!reader.IsConnected())
  {
    vtkErrorMacro("There is no surface. Connect what gives its pieces with "
                  "SetSurfaceConnection(), such as a vtkXMLPPolyDataReader.");
    return false;
  }
  in.IsSurveyed = false;
  reader.ForgetPieces();
  reader.NumberOfPieces = this->NumberOfPieces;
  reader.Boxes.assign(static_cast<std::size_t>(this->NumberOfPieces), {});
  reader.Offsets.clear();
  haptics::PartBox all;
  this->ForgetWhole();
  vtkSmartPointer<vtkPolyData> sample;
  haptics::PartOffset offset;
  std::string error;
  for (int i = 0; i < this->NumberOfPieces; ++i)
  {
    vtkPolyData* const piece = reader.Read(i, error);
    if (!piece)
    {
      return this->Report(false, error);
    }
    haptics::PartBox& box = reader.Boxes[static_cast<std::size_t>(i)];
    if (!haptics::MeasureUsedPoints(piece, box.Low, box.High, error))
    {
      vtkErrorMacro("Piece " << i << " of " << this->NumberOfPieces << ": " << error);
      return false;
    }
    all.Merge(box);
    if (!sample && !box.IsEmpty())
    {
      sample = haptics::CropPart(piece, { box.Low, box.Low, 0.0 }, {}); // no cell, or a few
    }
    reader.Offsets.push_back(offset);
    offset.Cells += piece->GetNumberOfCells();
    offset.Points += piece->GetNumberOfPoints();
    this->UpdateProgress(0.5 * (i + 1) / this->NumberOfPieces);
  }
  haptics::SurfaceCensus census;
  const haptics::CleaningFrame frame = haptics::FrameOf(all);
  for (int i = 0; i < this->NumberOfPieces; ++i)
  {
    if (reader.Boxes[static_cast<std::size_t>(i)].IsEmpty())
    {
      continue;
    }
    std::vector<haptics::PartBox> others = reader.Boxes;
    others.erase(others.begin() + i);
    vtkPolyData* const piece = reader.Read(i, error);
    if (!piece)
    {
      return this->Report(false, error);
    }
    haptics::CleaningOptions options;
    options.Frame = &frame;
    haptics::CleanedMesh cleaned;
    if (haptics::CleanSurface(piece, options, {}, cleaned, error) != haptics::CleaningResult::Done)
    {
      vtkErrorMacro(
        "Piece " << i << " of " << this->NumberOfPieces << " cannot be touched. " << error);
      return false;
    }
    census.Add(cleaned, frame, others);
    census.AddRanges(piece, cleaned);
    this->UpdateProgress(0.5 + 0.5 * (i + 1) / this->NumberOfPieces);
  }
  const haptics::PatchRecord record = census.Finish(all);
  if (record.Whole.Triangles == 0)
  {
    vtkErrorMacro("None of the " << this->NumberOfPieces
                                 << " pieces has a polygon or strip with an area to touch.");
    return false;
  }
  this->SetWhole(record, all, sample);
  in.IsSurveyed = true;
  in.SurveyedAt = time;
  in.SurveyedPieces = this->NumberOfPieces;
  return true;
}

bool vtkHapticPatchSource::Crop(
  const haptics::PatchRegion& region, Use, std::vector<vtkSmartPointer<vtkPolyData>>& parts)
{
  Internals& in = *this->Internal;
  haptics::PieceReader& reader = in.FreeReader();
  const std::optional<Internals::Cropping> fetched = std::exchange(in.Fetched, {});
  std::string error;
  bool isDone = false;
  if (fetched && AreSame(fetched->Region, region))
  {
    isDone = fetched->IsDone;
    error = fetched->Error;
    parts = fetched->Parts;
  }
  else
  {
    isDone = reader.Crop(region, parts, error);
  }
  return this->Report(isDone, error);
}

bool vtkHapticPatchSource::CropNearest(
  const haptics::Vec3& place, std::vector<vtkSmartPointer<vtkPolyData>>& parts)
{
  std::string error;
  const bool isDone = this->Internal->FreeReader().CropNearest(place, parts, error);
  return this->Report(isDone, error);
}

bool vtkHapticPatchSource::Report(bool isDone, const std::string& error)
{
  if (!isDone)
  {
    vtkErrorMacro(<< error);
  }
  return isDone;
}

void vtkHapticPatchSource::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "NumberOfPieces: " << this->NumberOfPieces << "\n";
  os << indent << "PiecesInMemory: " << this->GetPiecesInMemory() << "\n";
  os << indent << "ReadInBackground: " << this->ReadInBackground << "\n";
  os << indent << "NumberOfReads: " << this->GetNumberOfReads() << "\n";
}
