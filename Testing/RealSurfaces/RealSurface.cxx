#include "RealSurface.h"

#include "vtkNew.h"
#include "vtkSTLReader.h"
#include "vtkXMLPolyDataReader.h"

#include <fstream>

namespace haptics::testing
{
std::string PathOf(const RealSurface& surface)
{
  std::string path = std::string(HAPTICS_SURFACES_DIR) + "/" + surface.File;
  return std::ifstream(path).good() ? path : std::string();
}

vtkSmartPointer<vtkPolyData> Read(const std::string& path)
{
  const auto read = [&path](auto* reader) -> vtkSmartPointer<vtkPolyData>
  {
    reader->SetFileName(path.c_str());
    reader->Update();
    return reader->GetErrorCode() == 0 ? reader->GetOutput() : nullptr;
  };
  if (path.substr(path.size() - 4) == ".stl")
  {
    return read(vtkNew<vtkSTLReader>().Get());
  }
  return read(vtkNew<vtkXMLPolyDataReader>().Get());
}
}
