#include "PolyDataText.h"

#include "TextCheck.h"
#include "vtkAbstractArray.h"
#include "vtkCallbackCommand.h"
#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkCommand.h"
#include "vtkDataArray.h"
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

/// Gives arrays other names; what another one has as well is copied. Those without a name are left
/// out: the writer would make one up, another each time.
void RenameArrays(vtkDataSetAttributes* data, std::string (*renamed)(const std::string&))
{
  vtkNew<vtkDataSetAttributes> result;
  for (int i = 0; i < data->GetNumberOfArrays(); ++i)
  {
    vtkSmartPointer<vtkAbstractArray> array = data->GetAbstractArray(i);
    if (!array->GetName())
    {
      continue;
    }
    const std::string name = array->GetName();
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

/// Whether all corners are points that there are.
bool HasSoundCells(vtkPolyData* data)
{
  for (vtkCellArray* cells :
    { data->GetVerts(), data->GetLines(), data->GetPolys(), data->GetStrips() })
  {
    double range[2] = { 0.0, -1.0 };
    if (cells->GetNumberOfConnectivityIds() > 0)
    {
      cells->GetConnectivityArray()->GetRange(range, 0);
    }
    const bool isSound = cells->GetNumberOfCells() == 0 || cells->IsValid();
    if (!isSound || range[0] < 0.0 || range[1] >= static_cast<double>(data->GetNumberOfPoints()))
    {
      return false;
    }
  }
  return true;
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
  return WithCheck(writer->GetOutputString());
}

bool FromText(const std::string& text, vtkPolyData* data)
{
  data->Initialize();
  const vtkNew<vtkCallbackCommand> failure; // the caller says what is wrong
  bool hasFailed = false;
  failure->SetClientData(&hasFailed);
  failure->SetCallback(
    [](vtkObject*, unsigned long, void* flag, void*) { *static_cast<bool*>(flag) = true; });
  if (!IsUnchanged(text))
  {
    return false;
  }
  vtkNew<vtkXMLPolyDataReader> reader;
  reader->AddObserver(vtkCommand::ErrorEvent, failure);
  reader->SetParserErrorObserver(failure);
  reader->ReadFromInputStringOn();
  reader->SetInputString(text);
  reader->Update();
  vtkPolyData* const read = reader->GetOutput();
  if (hasFailed || reader->GetErrorCode() != 0 || !HasSoundCells(read))
  {
    return false;
  }
  data->ShallowCopy(read);
  RenameArrays(data, &Decoded);
  return true;
}
}
