// Traces over a scan of which little is in memory.
//
// usage: HapticsLargeScan --triangles N [--pieces N] [--peak MB] [--whole] [--ticks N]
//
// Writes a rough ground of float32 points in pieces to a folder of its own, strip by strip, and
// follows a stroke at 0.3 m/s over it: from patches, or, with --whole, over the surface as a whole.
// Prints times, the peak of its resident memory, and how often a piece was read. Ends with 1 where
// that peak is above --peak. (The address space is no measure: Embree and threads reserve it.)
#include "../TemporaryFolder.h"
#include "vtkGodObjectTrace.h"
#include "vtkHapticPatchSource.h"

#include "vtkCellArray.h"
#include "vtkDataArray.h"
#include "vtkFloatArray.h"
#include "vtkIdTypeArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkXMLPPolyDataReader.h"
#include "vtkXMLPolyDataWriter.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <new>
#include <string>

#include <sys/resource.h>

namespace
{
constexpr double Size = 0.3; // [m]

double Megabytes()
{
  rusage usage;
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024.0;
}

double Seconds()
{
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// Rows `first` to `last` of a ground of cells x cells squares.
void WriteStrip(const std::string& file, int first, int last, int cells)
{
  const vtkIdType rows = last - first;
  const vtkIdType across = cells + 1;
  vtkNew<vtkPoints> points;
  points->SetNumberOfPoints((rows + 1) * across);
  vtkNew<vtkFloatArray> height;
  height->SetName("height");
  height->SetNumberOfValues((rows + 1) * across);
  for (vtkIdType i = 0; i <= rows; ++i)
  {
    for (vtkIdType k = 0; k < across; ++k)
    {
      const double x = (static_cast<double>(first + i) / cells - 0.5) * Size;
      const double y = (static_cast<double>(k) / cells - 0.5) * Size;
      const double z = 0.004 * std::sin(90.0 * x) * std::cos(70.0 * y) +
        0.0008 * std::sin(700.0 * x + y) * std::sin(650.0 * y);
      points->SetPoint(i * across + k, x, y, z);
      height->SetValue(i * across + k, static_cast<float>(z));
    }
  }
  vtkNew<vtkIdTypeArray> offsets;
  vtkNew<vtkIdTypeArray> corners;
  const vtkIdType count = 2 * rows * cells;
  offsets->SetNumberOfValues(count + 1);
  corners->SetNumberOfValues(3 * count);
  vtkIdType* corner = corners->GetPointer(0);
  for (vtkIdType i = 0; i < rows; ++i)
  {
    for (vtkIdType k = 0; k < cells; ++k)
    {
      const vtkIdType a = i * across + k;
      for (const vtkIdType c : { a, a + across, a + across + 1, a, a + across + 1, a + 1 })
      {
        *corner++ = c;
      }
    }
  }
  for (vtkIdType i = 0; i <= count; ++i)
  {
    offsets->SetValue(i, 3 * i);
  }
  vtkNew<vtkCellArray> triangles;
  triangles->SetData(offsets, corners);
  vtkNew<vtkPolyData> strip;
  strip->SetPoints(points);
  strip->SetPolys(triangles);
  strip->GetPointData()->AddArray(height);
  vtkNew<vtkXMLPolyDataWriter> writer;
  writer->SetInputData(strip);
  writer->SetFileName(file.c_str());
  writer->SetDataModeToBinary(); // not every VTK reads appended data: see surfaces.py
  writer->SetCompressorTypeToNone();
  writer->Write();
}

void WriteScan(const std::string& folder, int pieces, int cells)
{
  std::ofstream list(folder + "/scan.pvtp");
  list << "<VTKFile type=\"PPolyData\" version=\"0.1\" byte_order=\"LittleEndian\"><PPolyData "
          "GhostLevel=\"0\"><PPointData><PDataArray type=\"Float32\" Name=\"height\"/></PPointData>"
          "<PPoints><PDataArray type=\"Float32\" Name=\"Points\" NumberOfComponents=\"3\"/>"
          "</PPoints>";
  for (int i = 0; i < pieces; ++i)
  {
    const std::string name = "strip" + std::to_string(i) + ".vtp";
    WriteStrip(folder + "/" + name, static_cast<int>(static_cast<std::int64_t>(i) * cells / pieces),
      static_cast<int>((static_cast<std::int64_t>(i) + 1) * cells / pieces), cells);
    list << "<Piece Source=\"" << name << "\"/>";
  }
  list << "</PPolyData></VTKFile>\n";
}

vtkSmartPointer<vtkPolyData> Stroke(int ticks)
{
  vtkNew<vtkPoints> places;
  places->SetDataTypeToDouble();
  for (int i = 0; i < ticks; ++i)
  {
    const double s = std::fmod(0.0003 * i, 0.4);
    places->InsertNextPoint(s < 0.2 ? s - 0.1 : 0.3 - s, 0.03 * std::sin(0.002 * i),
      (i < 100 ? 0.02 - 0.0002 * i : 0.0) - 0.002);
  }
  auto path = vtkSmartPointer<vtkPolyData>::New();
  path->SetPoints(places);
  return path;
}

int Run(const std::string& file, int pieces, int ticks, bool isWhole)
{
  const double before = Megabytes();
  vtkNew<vtkXMLPPolyDataReader> reader;
  reader->SetFileName(file.c_str());
  vtkNew<vtkHapticPatchSource> source;
  vtkNew<vtkGodObjectTrace> trace;
  trace->SetInputData(Stroke(ticks));
  double start = Seconds();
  if (isWhole)
  {
    trace->SetSurfaceConnection(reader->GetOutputPort());
  }
  else
  {
    source->SetSurfaceConnection(reader->GetOutputPort());
    source->SetNumberOfPieces(pieces);
    source->SetPiecesInMemory(2);
    source->SetPatchRadius(0.006);
    if (!source->Survey())
    {
      return 1;
    }
    std::printf("survey of %lld triangles: %.1f s, peak %.0f MB\n",
      static_cast<long long>(source->GetNumberOfTriangles()), Seconds() - start, Megabytes());
    trace->SetSurfaceConnection(source->GetOutputPort());
    start = Seconds();
  }
  trace->Update();
  vtkPolyData* const output = trace->GetOutput();
  vtkDataArray* const constraints = output->GetPointData()->GetArray("ActiveConstraints");
  vtkIdType touching = 0;
  double sum[3] = { 0.0, 0.0, 0.0 };
  for (vtkIdType i = 0; constraints && i < output->GetNumberOfPoints(); ++i)
  {
    touching += constraints->GetComponent(i, 0) > 0.0 ? 1 : 0;
    for (int axis = 0; axis < 3; ++axis)
    {
      sum[axis] += output->GetPoint(i)[axis];
    }
  }
  std::printf("trace of %lld ticks, %lld touching: %.1f s, %lld reads, peak %.0f MB (%.0f before); "
              "sum of places %.17g %.17g %.17g\n",
    static_cast<long long>(output->GetNumberOfPoints()), static_cast<long long>(touching),
    Seconds() - start, static_cast<long long>(source->GetNumberOfReads()), Megabytes(), before,
    sum[0], sum[1], sum[2]);
  return output->GetNumberOfPoints() == ticks && touching > ticks / 2 ? 0 : 1;
}
}

int main(int argc, char** argv)
{
  double triangles = 0.0;
  int pieces = 10;
  double peak = 0.0;
  int ticks = 3000;
  bool isWhole = false;
  for (int i = 1; i < argc; ++i)
  {
    const std::string option = argv[i];
    const char* const value = i + 1 < argc ? argv[i + 1] : "0";
    if (option == "--whole")
    {
      isWhole = true;
      continue;
    }
    triangles = option == "--triangles" ? std::atof(value) : triangles;
    pieces = option == "--pieces" ? std::atoi(value) : pieces;
    peak = option == "--peak" ? std::atof(value) : peak;
    ticks = option == "--ticks" ? std::atoi(value) : ticks;
    ++i;
  }
  if (!(triangles >= 2.0) || pieces < 1 || ticks < 1)
  {
    std::fprintf(
      stderr, "usage: %s --triangles N [--pieces N] [--peak MB] [--whole] [--ticks N]\n", argv[0]);
    return 2;
  }
  const TemporaryFolder folder;
  WriteScan(folder.Path, pieces, static_cast<int>(std::lround(std::sqrt(0.5 * triangles))));
  int result = 1;
  try
  {
    result = Run(folder.File("scan.pvtp"), pieces, ticks, isWhole);
    if (peak > 0.0 && Megabytes() > peak)
    {
      std::fprintf(stderr, "the peak is above %.0f MB\n", peak);
      result = 1;
    }
  }
  catch (const std::bad_alloc&)
  {
    std::fprintf(stderr, "memory ran out\n");
  }
  return result;
}
