#include "vtkHapticLandmarks.h"

#include "haptics/Files/OutputFile.h"
#include "haptics/Filters/LengthUnit.h"
#include "haptics/Filters/TraceCSV.h"
#include "haptics/Scene/FieldValues.h"
#include "haptics/Scene/GeodesicPath.h"
#include "haptics/Scene/HapticProbeFiller.h"
#include "haptics/Scene/SurfaceSet.h"
#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDoubleArray.h"
#include "vtkHapticProbe.h"
#include "vtkIdTypeArray.h"
#include "vtkInformation.h"
#include "vtkInformationStringKey.h"
#include "vtkIntArray.h"
#include "vtkMath.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkStringArray.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <locale>
#include <sstream>
#include <utility>

vtkStandardNewMacro(vtkHapticLandmarks);

namespace
{
template <class Array>
Array* AddArray(vtkPolyData* data, const char* name, int components)
{
  vtkNew<Array> array;
  array->SetName(name);
  array->SetNumberOfComponents(components);
  data->GetPointData()->AddArray(array);
  return array; // the data holds it
}

/// Every component of every array of the landmarks, under its name, each once.
std::vector<std::string> ColumnsOf(vtkDataSetAttributes* values)
{
  std::vector<std::string> columns;
  for (int i = 0; i < values->GetNumberOfArrays(); ++i)
  {
    vtkAbstractArray* array = values->GetAbstractArray(i);
    const int count = array->GetName() ? array->GetNumberOfComponents() : 0;
    for (int c = 0; c < count; ++c)
    {
      columns.push_back(
        std::string(array->GetName()) + (count > 1 ? "_" + std::to_string(c) : std::string()));
    }
  }
  return columns;
}

std::string ValueOf(vtkDataSetAttributes* values, const std::string& column)
{
  for (int i = 0; i < values->GetNumberOfArrays(); ++i)
  {
    vtkAbstractArray* array = values->GetAbstractArray(i);
    const int count = array->GetName() ? array->GetNumberOfComponents() : 0;
    for (int c = 0; c < count; ++c)
    {
      if (column ==
        std::string(array->GetName()) + (count > 1 ? "_" + std::to_string(c) : std::string()))
      {
        return haptics::CSVValue(array, 0, c);
      }
    }
  }
  return {};
}
}

/// Stays on its triangle by the weights of the corners.
struct vtkHapticLandmarks::Landmark
{
  vtkSmartPointer<vtkHapticProbe> Probe; // as it was dropped
  std::string Label;
  std::string Name;              // of the surface
  int Dropped = 0;               // how many were, with it
  vtkHapticProbe::Contact Where; // as it is now
  haptics::Vec3 Position{};      // world
  haptics::Vec3 Normal{};        // world, unit, on the side that was touched
  /// The triangle that was touched, in a surface with so many of them, by which one that comes out
  /// of a record finds its surface again.
  struct
  {
    vtkIdType Triangles = 0;
    haptics::Triangle Corners{};
  } Touched{};
  /// A snapshot with other cells, which is not looked at twice.
  std::shared_ptr<const haptics::TriangleSurface> Refused;
  /// The way along the surface from the landmark before, as it was found last.
  struct
  {
    const vtkHapticProbe* From = nullptr;
    std::shared_ptr<const haptics::TriangleSurface> Surface;
    double Length = 0.0;
  } Way{};

  /// The triangle's normal there, along the world's axes; of any length.
  haptics::Vec3 TriangleNormal() const
  {
    const haptics::TriangleSurface& surface = *this->Where.Surface;
    const haptics::Triangle& corners =
      surface.Triangles()[static_cast<std::size_t>(this->Where.Triangle)];
    haptics::Vec3 edges[2];
    for (int i = 0; i < 3; ++i)
    {
      const double from = surface.Points()[static_cast<std::size_t>(corners[0])][i];
      edges[0][i] = surface.Points()[static_cast<std::size_t>(corners[1])][i] - from;
      edges[1][i] = surface.Points()[static_cast<std::size_t>(corners[2])][i] - from;
    }
    haptics::Vec3 normal;
    vtkMath::Cross(edges[0].data(), edges[1].data(), normal.data());
    return this->Where.Pose.VectorToWorld(normal);
  }

  /// Where the point of its triangle is in a snapshot.
  haptics::Vec3 PlaceIn(const haptics::TriangleSurface& surface) const
  {
    const haptics::Triangle& corners =
      surface.Triangles()[static_cast<std::size_t>(this->Where.Triangle)];
    haptics::Vec3 local{};
    for (int i = 0; i < 3; ++i)
    {
      const auto along = [&](int k) {
        return this->Where.Weights[k] * surface.Points()[static_cast<std::size_t>(corners[k])][i];
      };
      local[i] = surface.Origin()[i] + (along(0) + along(1) + along(2));
    }
    return local;
  }

  /// Whether it was dropped on a surface with these triangles.
  bool IsOf(const haptics::HapticSurface& surface) const
  {
    const auto touched = surface.TouchableSurface();
    const auto triangle = static_cast<std::size_t>(this->Where.Triangle);
    const auto& cells = surface.OriginalCellIds();
    return touched && triangle < touched->Triangles().size() &&
      static_cast<vtkIdType>(touched->Triangles().size()) == this->Touched.Triangles &&
      touched->Triangles()[triangle] == this->Touched.Corners &&
      (!cells || (triangle < cells->size() && (*cells)[triangle] == this->Probe->GetCell()));
  }

  /// Whether it lies on such a surface, where that is now.
  bool LiesOn(const haptics::HapticSurface& surface) const
  {
    constexpr double rounding = 1e-6; // of single precision, in which data may be kept
    if (!this->IsOf(surface))
    {
      return false;
    }
    const haptics::Vec3 place =
      surface.Pose().PointToWorld(this->PlaceIn(*surface.TouchableSurface()));
    return std::sqrt(vtkMath::Distance2BetweenPoints(place.data(), this->Position.data())) <=
      rounding * vtkMath::Norm(this->Position.data());
  }

  /// Looks for its surface, where it came out of a record: by its name, or, where no surface has
  /// that, the only one that it lies on, which was renamed. Whether it has one.
  bool FindSurface(const haptics::SurfaceSet& surfaces)
  {
    bool isNamed = false;
    const haptics::HapticSurface* named = nullptr;
    std::vector<const haptics::HapticSurface*> others;
    for (const auto& surface : surfaces.All())
    {
      if (surface->Name == this->Name)
      {
        isNamed = true;
        named = !named && this->IsOf(*surface) ? surface.get() : named;
      }
      else if (this->LiesOn(*surface))
      {
        others.push_back(surface.get());
      }
    }
    const haptics::HapticSurface* const found = isNamed ? named
      : others.size() == 1                              ? others.front()
                                                        : nullptr;
    if (!found)
    {
      return false;
    }
    vtkHapticProbeFiller::SetSurface(this->Probe, found->Id());
    this->Where.Surface = found->TouchableSurface();
    this->Where.Pose = found->Pose();
    return true;
  }

  /// Whether it is elsewhere now.
  bool Follow(
    const std::shared_ptr<const haptics::TriangleSurface>& surface, const haptics::RigidPose& pose)
  {
    if (surface != this->Where.Surface)
    {
      // Snapshots that deform share their triangles; one that was scaled has equal ones.
      if (surface == this->Refused || surface->Triangles() != this->Where.Surface->Triangles())
      {
        this->Refused = surface;
        return false;
      }
    }
    const bool isBehind = vtkMath::Dot(this->TriangleNormal().data(), this->Normal.data()) < 0.0;
    this->Where.Surface = surface;
    this->Where.Pose = pose;
    const haptics::Vec3 local = this->PlaceIn(*surface);
    this->Where.Position = local;
    const haptics::Vec3 before = std::exchange(this->Position, pose.PointToWorld(local));
    haptics::Vec3 normal = this->TriangleNormal();
    if (vtkMath::Normalize(normal.data()) > 0.0)
    {
      vtkMath::MultiplyScalar(normal.data(), isBehind ? -1.0 : 1.0);
      this->Normal = normal;
    }
    return this->Position != before;
  }
};

vtkHapticLandmarks::vtkHapticLandmarks() = default;
vtkHapticLandmarks::~vtkHapticLandmarks() = default;

bool vtkHapticLandmarks::Has(int number)
{
  if (number >= 0 && number < this->GetNumberOfLandmarks())
  {
    return true;
  }
  vtkErrorMacro("There is no landmark " << number << "; there are " << this->GetNumberOfLandmarks()
                                        << ", counted from 0.");
  return false;
}

int vtkHapticLandmarks::Drop(vtkHapticProbe* probe, const char* label)
{
  if (!probe || !probe->GetTouching())
  {
    vtkErrorMacro("A landmark needs a contact, and nothing is touched. Touch a surface first.");
    return -1;
  }
  ++this->Dropped;
  const double* const position = probe->GetPosition();
  const double* const normal = probe->GetNormal();
  Landmark landmark;
  landmark.Probe = probe;
  landmark.Label = label ? label : std::to_string(this->Dropped);
  landmark.Dropped = this->Dropped;
  landmark.Name = vtkHapticProbeFiller::SurfaceName(probe);
  landmark.Where = probe->GetContact();
  std::copy_n(position, 3, landmark.Position.begin());
  std::copy_n(normal, 3, landmark.Normal.begin());
  if (landmark.Where.Surface)
  {
    const auto& triangles = landmark.Where.Surface->Triangles();
    landmark.Touched.Triangles = static_cast<vtkIdType>(triangles.size());
    landmark.Touched.Corners = triangles[static_cast<std::size_t>(landmark.Where.Triangle)];
  }
  this->Landmarks.push_back(landmark);
  this->Modified();
  return this->GetNumberOfLandmarks() - 1;
}

void vtkHapticLandmarks::GetRecord(int number, vtkPolyData* record)
{
  record->Initialize();
  if (!this->Has(number))
  {
    return;
  }
  const Landmark& landmark = this->Landmarks[static_cast<std::size_t>(number)];
  vtkHapticProbeFiller::Save(landmark.Probe, record);
  haptics::FieldValues values(record->GetFieldData());
  values.Set("SurfaceName", landmark.Name);
  values.Set("Label", landmark.Label);
  const vtkIdType dropped = landmark.Dropped;
  values.Set("Dropped", &dropped, 1);
  values.Set("PositionNow", landmark.Position.data(), 3);
  values.Set("NormalNow", landmark.Normal.data(), 3);
  values.Set("NumberOfTriangles", &landmark.Touched.Triangles, 1);
  vtkIdType corners[3];
  std::copy(landmark.Touched.Corners.begin(), landmark.Touched.Corners.end(), corners);
  values.Set("Corners", corners, 3);
}

int vtkHapticLandmarks::Add(vtkPolyData* record)
{
  Landmark landmark;
  landmark.Probe = vtkSmartPointer<vtkHapticProbe>::New();
  bool isWhole = record && vtkHapticProbeFiller::Load(record, landmark.Probe);
  if (isWhole)
  {
    const haptics::FieldValues values(record->GetFieldData());
    isWhole = values.Get("Label", landmark.Label) && values.Get("Dropped", &landmark.Dropped, 1) &&
      values.Get("SurfaceName", landmark.Name) &&
      values.Get("PositionNow", landmark.Position.data(), 3) &&
      values.Get("NormalNow", landmark.Normal.data(), 3) &&
      values.Get("NumberOfTriangles", &landmark.Touched.Triangles, 1) &&
      values.Get("Corners", landmark.Touched.Corners.data(), 3);
  }
  if (!isWhole)
  {
    vtkErrorMacro("The polydata are no landmark's. Give what GetRecord() makes.");
    return -1;
  }
  landmark.Where = landmark.Probe->GetContact();
  this->Dropped = std::max(this->Dropped, landmark.Dropped);
  this->Landmarks.push_back(landmark);
  this->Modified();
  return this->GetNumberOfLandmarks() - 1;
}

void vtkHapticLandmarks::Follow(const haptics::SurfaceSet& surfaces)
{
  bool moved = false;
  for (Landmark& landmark : this->Landmarks)
  {
    const bool isFound = !landmark.Where.Surface && landmark.FindSurface(surfaces);
    const haptics::HapticSurface* const surface = surfaces.Find(landmark.Probe->GetSurface());
    const auto touched = surface ? surface->TouchableSurface() : nullptr;
    if (touched && landmark.Where.Surface)
    {
      const bool isRenamed = std::exchange(landmark.Name, surface->Name) != surface->Name;
      moved = landmark.Follow(touched, surface->Pose()) || isFound || isRenamed || moved;
    }
  }
  if (moved)
  {
    this->Modified();
  }
}

void vtkHapticLandmarks::SetUnitLength(double metres)
{
  haptics::SetLength(this, "UnitLength", this->UnitLength, metres);
}

bool vtkHapticLandmarks::Undo()
{
  if (this->Landmarks.empty())
  {
    return false;
  }
  this->Landmarks.pop_back();
  this->Dropped = std::max(0, this->Dropped - 1);
  this->Modified();
  return true;
}

bool vtkHapticLandmarks::Remove(int number)
{
  if (number < 0 || number >= this->GetNumberOfLandmarks())
  {
    return false;
  }
  this->Landmarks.erase(this->Landmarks.begin() + number);
  this->Modified();
  return true;
}

void vtkHapticLandmarks::RemoveAll()
{
  this->Dropped = 0;
  if (!this->Landmarks.empty())
  {
    this->Landmarks.clear();
    this->Modified();
  }
}

int vtkHapticLandmarks::GetNumberOfFreeLandmarks()
{
  return static_cast<int>(std::count_if(this->Landmarks.begin(), this->Landmarks.end(),
    [](const Landmark& landmark) { return !landmark.Where.Surface; }));
}

int vtkHapticLandmarks::GetNumberOfLandmarks()
{
  return static_cast<int>(this->Landmarks.size());
}

vtkHapticProbe* vtkHapticLandmarks::GetLandmark(int number)
{
  return number >= 0 && number < this->GetNumberOfLandmarks()
    ? this->Landmarks[static_cast<std::size_t>(number)].Probe.Get()
    : nullptr;
}

void vtkHapticLandmarks::GetPosition(int number, double position[3])
{
  std::fill_n(position, 3, 0.0);
  if (this->Has(number))
  {
    const haptics::Vec3& now = this->Landmarks[static_cast<std::size_t>(number)].Position;
    std::copy(now.begin(), now.end(), position);
  }
}

std::string vtkHapticLandmarks::GetLabel(int number)
{
  return this->GetLandmark(number) ? this->Landmarks[static_cast<std::size_t>(number)].Label
                                   : std::string();
}

void vtkHapticLandmarks::SetLabel(int number, const char* label)
{
  if (this->Has(number))
  {
    this->Landmarks[static_cast<std::size_t>(number)].Label = label ? label : "";
    this->Modified();
  }
}

double vtkHapticLandmarks::GetStraightDistance(int first, int second)
{
  if (!this->Has(first) || !this->Has(second))
  {
    return vtkMath::Nan();
  }
  return std::sqrt(vtkMath::Distance2BetweenPoints(
    this->Landmarks[static_cast<std::size_t>(first)].Position.data(),
    this->Landmarks[static_cast<std::size_t>(second)].Position.data()));
}

double vtkHapticLandmarks::StraightToPrevious(int number)
{
  return number > 0 ? this->GetStraightDistance(number - 1, number) : vtkMath::Nan();
}

/// Found anew only where it may have changed: a way costs about as much as building the surface.
double vtkHapticLandmarks::AlongSurfaceToPrevious(int number)
{
  if (number < 1 || !this->AreOnOneSurface(number - 1, number))
  {
    return vtkMath::Nan();
  }
  Landmark& landmark = this->Landmarks[static_cast<std::size_t>(number)];
  const vtkHapticProbe* const from = this->Landmarks[static_cast<std::size_t>(number) - 1].Probe;
  if (landmark.Way.From != from || landmark.Way.Surface != landmark.Where.Surface)
  {
    landmark.Way = { from, landmark.Where.Surface, this->FindWay(number - 1, number, nullptr) };
  }
  return landmark.Way.Length;
}

double vtkHapticLandmarks::GetDistanceToPrevious(int number)
{
  if (!this->Has(number) || this->Distance == NO_DISTANCE)
  {
    return vtkMath::Nan();
  }
  return this->Distance == STRAIGHT ? this->StraightToPrevious(number)
                                    : this->AlongSurfaceToPrevious(number);
}

std::string vtkHapticLandmarks::GetText(int number)
{
  if (!this->Has(number))
  {
    return {};
  }
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text.precision(5);
  text << this->Landmarks[static_cast<std::size_t>(number)].Label;
  const double distance = this->GetDistanceToPrevious(number);
  if (std::isfinite(distance))
  {
    const std::string unit = haptics::LengthUnitName(this->UnitLength);
    text << ": " << distance << (unit.empty() ? "" : " ") << unit;
  }
  return text.str();
}

bool vtkHapticLandmarks::AreOnOneSurface(int first, int second) const
{
  const auto& surface = this->Landmarks[static_cast<std::size_t>(first)].Where.Surface;
  return surface && surface == this->Landmarks[static_cast<std::size_t>(second)].Where.Surface;
}

double vtkHapticLandmarks::GetGeodesicDistance(int first, int second, vtkPolyData* path)
{
  if (!this->Has(first) || !this->Has(second))
  {
    return vtkMath::Nan();
  }
  if (!this->AreOnOneSurface(first, second))
  {
    vtkErrorMacro("Landmarks " << first << " and " << second
                               << " lie on two surfaces, or on one whose cells changed in "
                                  "between; there is no way along it. Drop them anew.");
    return vtkMath::Nan();
  }
  return this->FindWay(first, second, path);
}

double vtkHapticLandmarks::FindWay(int first, int second, vtkPolyData* path) const
{
  const auto end = [this](int number)
  {
    const vtkHapticProbe::Contact& where = this->Landmarks[static_cast<std::size_t>(number)].Where;
    haptics::SurfacePoint point;
    point.Triangle = where.Triangle;
    point.Position = where.Position;
    return point;
  };
  const vtkHapticProbe::Contact& where = this->Landmarks[static_cast<std::size_t>(second)].Where;
  const haptics::GeodesicPath found =
    haptics::FindGeodesicPath(*where.Surface, end(first), end(second));
  if (path)
  {
    path->Initialize();
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    vtkNew<vtkCellArray> lines;
    lines->InsertNextCell(static_cast<int>(found.Points.size()));
    for (const haptics::Vec3& point : found.Points)
    {
      lines->InsertCellPoint(points->InsertNextPoint(where.Pose.PointToWorld(point).data()));
    }
    path->SetPoints(points);
    if (!found.Points.empty())
    {
      path->SetLines(lines);
    }
  }
  return found.Length;
}

vtkPolyData* vtkHapticLandmarks::GetOutput()
{
  if (this->OutputTime == this->GetMTime())
  {
    return this->Output;
  }
  this->OutputTime = this->GetMTime();
  this->Output->Initialize();
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkCellArray> verts;
  auto* labels = AddArray<vtkStringArray>(this->Output, "Label", 1);
  auto* texts = AddArray<vtkStringArray>(this->Output, "Text", 1);
  auto* surfaces = AddArray<vtkIntArray>(this->Output, "Surface", 1);
  auto* cells = AddArray<vtkIdTypeArray>(this->Output, "OriginalCellId", 1);
  auto* ids = AddArray<vtkIdTypeArray>(this->Output, "PointIds", 3);
  auto* weights = AddArray<vtkDoubleArray>(this->Output, "Weights", 3);
  auto* normals = AddArray<vtkDoubleArray>(this->Output, "Normal", 3);
  auto* forces = AddArray<vtkDoubleArray>(this->Output, "Force", 3);
  auto* distances = AddArray<vtkDoubleArray>(this->Output, "DistanceToPrevious", 1);
  forces->GetInformation()->Set(vtkDataArray::UNITS_LABEL(), "N");
  const std::string unit = haptics::LengthUnitName(this->UnitLength);
  vtkDoubleArray* const ways = this->Distance == ALONG_SURFACE
    ? AddArray<vtkDoubleArray>(this->Output, "DistanceAlongSurface", 1)
    : nullptr;
  for (vtkDataArray* const lengths :
    { points->GetData(), static_cast<vtkDataArray*>(distances), static_cast<vtkDataArray*>(ways) })
  {
    if (lengths && !unit.empty())
    {
      lengths->GetInformation()->Set(vtkDataArray::UNITS_LABEL(), unit.c_str());
    }
  }
  for (const Landmark& landmark : this->Landmarks)
  {
    vtkHapticProbe* probe = landmark.Probe;
    const vtkIdType id = points->InsertNextPoint(landmark.Position.data());
    distances->InsertNextValue(this->StraightToPrevious(static_cast<int>(id)));
    if (ways)
    {
      ways->InsertNextValue(this->AlongSurfaceToPrevious(static_cast<int>(id)));
    }
    verts->InsertNextCell(1, &id);
    labels->InsertNextValue(landmark.Label);
    texts->InsertNextValue(this->GetText(static_cast<int>(id)));
    surfaces->InsertNextValue(probe->GetSurface());
    cells->InsertNextValue(probe->GetCell());
    const vtkIdType corners[3] = { probe->GetPointId(0), probe->GetPointId(1),
      probe->GetPointId(2) };
    ids->InsertNextTypedTuple(corners);
    weights->InsertNextTypedTuple(probe->GetWeights());
    normals->InsertNextTypedTuple(landmark.Normal.data());
    forces->InsertNextTypedTuple(probe->GetForce());
  }
  this->Output->SetPoints(points);
  this->Output->SetVerts(verts);
  return this->Output;
}

bool vtkHapticLandmarks::WriteCSV(const char* file)
{
  std::ostringstream stream;
  stream.imbue(std::locale::classic());
  std::vector<std::string> columns;
  for (const Landmark& landmark : this->Landmarks)
  {
    for (vtkDataSetAttributes* values :
      { static_cast<vtkDataSetAttributes*>(landmark.Probe->GetPointValues()),
        static_cast<vtkDataSetAttributes*>(landmark.Probe->GetCellValues()) })
    {
      for (const std::string& column : ColumnsOf(values))
      {
        if (std::find(columns.begin(), columns.end(), column) == columns.end())
        {
          columns.push_back(column);
        }
      }
    }
  }
  stream << "label,x,y,z,surface,cell,point_0,point_1,point_2,weight_0,weight_1,weight_2,"
            "distance_to_previous";
  for (const std::string& column : columns)
  {
    stream << "," << haptics::CSVField(column);
  }
  stream << "\r\n";
  stream.precision(std::numeric_limits<double>::max_digits10);
  for (const Landmark& landmark : this->Landmarks)
  {
    vtkHapticProbe* probe = landmark.Probe;
    const haptics::Vec3& p = landmark.Position;
    stream << haptics::CSVField(landmark.Label) << "," << p[0] << "," << p[1] << "," << p[2] << ","
           << probe->GetSurface() << "," << probe->GetCell();
    for (int i = 0; i < 3; ++i)
    {
      stream << "," << probe->GetPointId(i);
    }
    for (int i = 0; i < 3; ++i)
    {
      stream << "," << probe->GetWeight(i);
    }
    const auto number = static_cast<int>(&landmark - this->Landmarks.data());
    stream << "," << this->StraightToPrevious(number);
    for (const std::string& column : columns)
    {
      const std::string value = ValueOf(probe->GetPointValues(), column);
      stream << "," << (value.empty() ? ValueOf(probe->GetCellValues(), column) : value);
    }
    stream << "\r\n";
  }
  const std::string text = stream.str();
  std::string error;
  if (!haptics::OutputFile::WriteWhole(file ? file : "", text.data(), text.size(), error))
  {
    vtkErrorMacro("The landmarks' file " << error);
    return false;
  }
  return true;
}

void vtkHapticLandmarks::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  static const char* const distances[] = { "none", "straight", "along the surface" };
  os << indent << "Distance: " << distances[this->Distance] << "\n";
  os << indent << "Button: " << this->Button << "\n";
  os << indent << "Landmarks: " << this->Landmarks.size() << "\n";
  for (const Landmark& landmark : this->Landmarks)
  {
    const haptics::Vec3& p = landmark.Position;
    os << indent.GetNextIndent() << landmark.Label << ": (" << p[0] << ", " << p[1] << ", " << p[2]
       << "), surface " << landmark.Probe->GetSurface() << ", cell " << landmark.Probe->GetCell()
       << "\n";
  }
}
