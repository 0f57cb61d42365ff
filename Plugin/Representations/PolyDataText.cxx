#include "PolyDataText.h"

#include "vtkAbstractArray.h"
#include "vtkCellData.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkXMLPolyDataReader.h"
#include "vtkXMLPolyDataWriter.h"

#include <vtksys/SystemTools.hxx>

#include <cstdio>
#include <cstring>

namespace haptics
{
namespace
{
/// VTK's writer puts names of arrays into XML as they are: what XML does not bear, and %, is %XX.
std::string Encoded(const std::string& name)
{
  std::string text;
  for (const unsigned char c : name)
  {
    if (c >= ' ' && !std::strchr("%\"<>&\x7f", c))
    {
      text += static_cast<char>(c);
      continue;
    }
    char code[4];
    std::snprintf(code, sizeof(code), "%%%02X", c);
    text += code;
  }
  return text;
}

std::string Decoded(const std::string& text)
{
  return vtksys::SystemTools::DecodeURL(text);
}

/// Gives arrays other names; what another one has as well is copied.
void RenameArrays(vtkDataSetAttributes* data, std::string (*renamed)(const std::string&))
{
  vtkNew<vtkDataSetAttributes> result;
  for (int i = 0; i < data->GetNumberOfArrays(); ++i)
  {
    vtkSmartPointer<vtkAbstractArray> array = data->GetAbstractArray(i);
    const std::string name = array->GetName() ? array->GetName() : "";
    const std::string other = renamed(name);
    if (other != name)
    {
      array.TakeReference(array->NewInstance());
      array->DeepCopy(data->GetAbstractArray(i));
      array->SetName(other.c_str());
    }
    const int at = result->AddArray(array);
    const int purpose = data->IsArrayAnAttribute(i);
    if (purpose >= 0)
    {
      result->SetActiveAttribute(at, purpose);
    }
  }
  data->ShallowCopy(result);
}

void RenameArrays(vtkPolyData* data, std::string (*renamed)(const std::string&))
{
  RenameArrays(data->GetPointData(), renamed);
  RenameArrays(data->GetCellData(), renamed);
}
}

std::string ToText(vtkPolyData* data)
{
  vtkNew<vtkPolyData> written;
  written->ShallowCopy(data);
  RenameArrays(written, &Encoded);
  vtkNew<vtkXMLPolyDataWriter> writer;
  writer->SetInputData(written);
  writer->SetDataModeToBinary(); // base64: no byte that a property or XML could not hold
  writer->WriteToOutputStringOn();
  writer->Write();
  return writer->GetOutputString();
}

bool FromText(const std::string& text, vtkPolyData* data)
{
  vtkNew<vtkXMLPolyDataReader> reader;
  reader->ReadFromInputStringOn();
  reader->SetInputString(text);
  reader->Update();
  data->ShallowCopy(reader->GetOutput());
  RenameArrays(data, &Decoded);
  return reader->GetErrorCode() == 0;
}
}
