#include "vtkHapticRecordSource.h"

#include "vtkDoubleArray.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMath.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkXMLPolyDataReader.h"
#include "vtkXMLPolyDataWriter.h"

vtkStandardNewMacro(vtkHapticRecordSource);

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
  }
  vtkNew<vtkXMLPolyDataWriter> writer;
  writer->SetInputData(written);
  writer->SetDataModeToBinary(); // base64: no byte that a property or XML could not hold
  writer->WriteToOutputStringOn();
  writer->Write();
  return writer->GetOutputString();
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
  vtkNew<vtkXMLPolyDataReader> reader;
  reader->ReadFromInputStringOn();
  reader->SetInputString(this->Contents);
  reader->Update();
  if (reader->GetErrorCode() != 0)
  {
    vtkErrorMacro("The contents are no polydata. Give what MakeContents() makes.");
    return 0;
  }
  vtkPolyData::GetData(outputVector)->ShallowCopy(reader->GetOutput());
  return 1;
}

void vtkHapticRecordSource::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Contents [bytes]: " << this->Contents.size() << "\n";
}
