#include "vtkHapticRecordSource.h"

#include "PolyDataText.h"
#include "vtkBoundingBox.h"
#include "vtkCellArray.h"
#include "vtkDoubleArray.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMath.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <cmath>
#include <vector>

vtkStandardNewMacro(vtkHapticRecordSource);

namespace
{
constexpr double PointsAcross = 2000.0; // of a curve, along the diagonal of all curves
}

vtkHapticRecordSource::vtkHapticRecordSource()
{
  this->SetNumberOfInputPorts(0);
}

vtkHapticRecordSource::~vtkHapticRecordSource() = default;

void vtkHapticRecordSource::SetContents(const char* contents)
{
  const std::string wanted = contents ? contents : "";
  if (wanted != this->Contents)
  {
    this->Contents = wanted;
    this->Modified();
  }
}

std::string vtkHapticRecordSource::MakeContents(vtkPolyData* record)
{
  if (!record)
  {
    return {};
  }
  vtkNew<vtkPolyData> written;
  written->ShallowCopy(record);
  if (vtkDataArray* force = written->GetPointData()->GetArray("Force"))
  {
    vtkNew<vtkDoubleArray> magnitude;
    magnitude->SetName("ForceMagnitude");
    magnitude->SetNumberOfTuples(force->GetNumberOfTuples());
    for (vtkIdType i = 0; i < force->GetNumberOfTuples(); ++i)
    {
      magnitude->SetValue(i, vtkMath::Norm(force->GetTuple3(i)));
    }
    written->GetPointData()->AddArray(magnitude);
    written->GetPointData()->SetActiveScalars("ForceMagnitude"); // by which ParaView colours it
  }
  return haptics::ToText(written);
}

void vtkHapticRecordSource::MakeCurves(vtkPolyData* trace, vtkIdType first, vtkPolyData* curves)
{
  curves->Initialize();
  vtkDataArray* surface = trace ? trace->GetPointData()->GetArray("Surface") : nullptr;
  if (!surface)
  {
    return;
  }
  const auto isContact = [surface](vtkIdType tick)
  { return surface->GetComponent(tick, 0) >= 0.0; };
  vtkBoundingBox reach;
  for (vtkIdType tick = first; tick < trace->GetNumberOfPoints(); ++tick)
  {
    if (isContact(tick))
    {
      reach.AddPoint(trace->GetPoint(tick));
    }
  }
  const double spacing = reach.IsValid() ? reach.GetDiagonalLength() / PointsAcross : 0.0;

  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkCellArray> lines;
  vtkNew<vtkDoubleArray> lengths;
  lengths->SetName("arc_length");
  curves->GetPointData()->CopyAllocate(trace->GetPointData());
  std::vector<vtkIdType> curve; // ticks of the trace
  std::vector<double> length;   // up to each
  const auto end = [&]
  {
    if (curve.size() > 1)
    {
      lines->InsertNextCell(static_cast<int>(curve.size()));
      for (std::size_t i = 0; i < curve.size(); ++i)
      {
        const vtkIdType point = points->InsertNextPoint(trace->GetPoint(curve[i]));
        curves->GetPointData()->CopyData(trace->GetPointData(), curve[i], point);
        lengths->InsertNextValue(length[i]);
        lines->InsertCellPoint(point);
      }
    }
    curve.clear();
    length.clear();
  };
  for (vtkIdType tick = first; tick < trace->GetNumberOfPoints(); ++tick)
  {
    double here[3];
    trace->GetPoint(tick, here);
    const double moved = curve.empty()
      ? 0.0
      : std::sqrt(vtkMath::Distance2BetweenPoints(here, trace->GetPoint(curve.back())));
    if (!isContact(tick))
    {
      end();
    }
    else if (curve.empty() || (moved > 0.0 && moved >= spacing))
    {
      length.push_back(curve.empty() ? 0.0 : length.back() + moved);
      curve.push_back(tick);
    }
  }
  end();
  curves->SetPoints(points);
  curves->SetLines(lines);
  curves->GetPointData()->AddArray(lengths);
}

int vtkHapticRecordSource::RequestData(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector)
{
  vtkInformation* information = outputVector->GetInformationObject(0);
  const int piece = information->Get(vtkStreamingDemandDrivenPipeline::UPDATE_PIECE_NUMBER());
  if (this->Contents.empty() || piece > 0)
  {
    return 1;
  }
  vtkNew<vtkPolyData> record;
  if (!haptics::FromText(this->Contents, record))
  {
    vtkErrorMacro(
      "The contents are no polydata, or were cut or changed. Give what MakeContents() makes.");
    return 0;
  }
  vtkPolyData::GetData(outputVector)->ShallowCopy(record);
  return 1;
}

void vtkHapticRecordSource::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Contents [bytes]: " << this->Contents.size() << "\n";
}
