#include "HapticDeviceChoice.h"

#include "vtkBoundingBox.h"
#include "vtkDataArray.h"
#include "vtkHapticScene.h"
#include "vtkMath.h"
#include "vtkMatrix4x4.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkRecordedHapticDevice.h"
#include "vtkXMLPolyDataReader.h"

#include <vtksys/SystemTools.hxx>

#include <algorithm>
#include <cmath>

namespace haptics
{
namespace
{
constexpr int StrokeSamples = 400;       // rays cast to find a stroke
constexpr double StrokeShare = 0.35;     // of the workspace's half extent that a stroke covers
constexpr double StrokeDepth = 0.003;    // below the surface [m]: 1.5 N at 500 N/m
constexpr double StrokeClearance = 0.02; // above it before and after [m]
constexpr double StrokeLift = 0.004;     // above it where it would go through something [m]
constexpr double WallSlope = 2.0;        // that a stroke does not follow
constexpr double StrokeSpeed = 0.05;     // [m/s], where a path has no times
constexpr const char* PathFollower = "simulated";

vtkSmartPointer<vtkPolyData> Polyline(vtkPoints* points, vtkDataArray* time)
{
  auto path = vtkSmartPointer<vtkPolyData>::New();
  path->SetPoints(points);
  if (time)
  {
    path->GetPointData()->AddArray(time);
  }
  return path;
}
}

DeviceChoice DeviceChoice::Make(const std::string& name, std::string& error)
{
  DeviceChoice choice;
  const std::string problem = vtkHapticDevice::GetNameProblem(name.c_str());
  if (problem.empty())
  {
    choice.Chosen =
      vtkSmartPointer<vtkHapticDevice>::Take(vtkHapticDevice::CreateByName(name.c_str()));
    choice.MakesStroke = choice.Chosen->NeedsPath();
  }
  else if (!vtksys::SystemTools::FileExists(name, true))
  {
    error = "'" + name + "' is neither a device nor a file with a recording or a path. " + problem;
  }
  else if (vtksys::SystemTools::GetFilenameLastExtension(name) != ".vtp")
  {
    auto recorded = vtkSmartPointer<vtkRecordedHapticDevice>::New();
    recorded->SetFileName(name);
    if (recorded->Open()) // which reports what it reaches, needed to fit it
    {
      choice.Chosen = recorded;
    }
    else
    {
      error = recorded->GetErrorMessage();
    }
  }
  else if (choice.ReadPath(name, error))
  {
    choice.Chosen =
      vtkSmartPointer<vtkHapticDevice>::Take(vtkHapticDevice::CreateByName(PathFollower));
  }
  return choice;
}

bool DeviceChoice::ReadPath(const std::string& file, std::string& error)
{
  vtkNew<vtkXMLPolyDataReader> reader;
  reader->SetFileName(file.c_str());
  reader->Update();
  vtkPolyData* read = reader->GetOutput();
  if (reader->GetErrorCode() != 0 || read->GetNumberOfPoints() < 2)
  {
    error = file + ": holds no path of a hand. Give a .vtp with at least two points.";
    return false;
  }
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkDataArray* hip = read->GetPointData()->GetArray("HapticInterfacePoint");
  for (vtkIdType i = 0; i < read->GetNumberOfPoints(); ++i)
  {
    points->InsertNextPoint(
      hip && hip->GetNumberOfComponents() == 3 ? hip->GetTuple3(i) : read->GetPoint(i));
  }
  this->Path = Polyline(points, read->GetPointData()->GetArray("Time"));
  return true;
}

bool DeviceChoice::MakeStroke(vtkHapticScene* scene)
{
  if (!this->MakesStroke)
  {
    return true;
  }
  vtkMatrix4x4* toWorld = scene->GetWorkspaceTransform();
  const auto world = [toWorld](double x, double y, double z, double w, double result[4])
  {
    const double device[4] = { x, y, z, w };
    toWorld->MultiplyPoint(device, result);
  };
  double bounds[6];
  this->Chosen->GetWorkspaceBounds(bounds);
  const double center[3] = { 0.5 * (bounds[0] + bounds[1]), 0.5 * (bounds[2] + bounds[3]),
    0.5 * (bounds[4] + bounds[5]) };
  double down[4];
  world(0.0, 0.0, -1.0, 0.0, down); // a metre of the device long
  const double metre = vtkMath::Norm(down);
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  const auto goTo = [&points, &down](const double hit[3], double below)
  {
    points->InsertNextPoint(
      hit[0] + below * down[0], hit[1] + below * down[1], hit[2] + below * down[2]);
  };
  struct Place
  {
    double X;
    double Y;
    double Hit[3] = { 0.0, 0.0, 0.0 }; ///< on the surface below
    double Depth = 0.0;                ///< of it, from the front of what the hand reaches [m]
  };
  const auto findSurface = [&](Place& place)
  {
    double from[4];
    world(place.X, place.Y, bounds[5], 1.0, from);
    const bool found = scene->IntersectRay(from, down, place.Hit);
    place.Depth = std::sqrt(vtkMath::Distance2BetweenPoints(from, place.Hit)) / metre;
    return found;
  };
  const auto isWall = [](const Place& one, const Place& other)
  {
    return std::abs(one.Depth - other.Depth) >
      WallSlope * std::hypot(one.X - other.X, one.Y - other.Y);
  };
  Place last{ 0.0, 0.0 };
  bool isOnSurface = false;
  for (int i = 0; i < StrokeSamples; ++i)
  {
    // A smooth closed curve around the middle of what the hand reaches.
    const double s = 2.0 * vtkMath::Pi() * i / StrokeSamples;
    Place place{ center[0] + StrokeShare * 0.5 * (bounds[1] - bounds[0]) * std::sin(2.0 * s),
      center[1] + StrokeShare * 0.5 * (bounds[3] - bounds[2]) * std::cos(3.0 * s) };
    if (!findSurface(place))
    {
      isOnSurface = false;
      continue;
    }
    if (points->GetNumberOfPoints() == 0)
    {
      goTo(place.Hit, -StrokeClearance);
    }
    else if (!isOnSurface || isWall(last, place))
    {
      // Straight on, the hand would go through what lies behind.
      const double top = std::min(place.Depth, last.Depth) - StrokeLift;
      goTo(last.Hit, top - last.Depth);
      goTo(place.Hit, top - place.Depth);
    }
    goTo(place.Hit, StrokeDepth);
    last = place;
    isOnSurface = true;
  }
  if (points->GetNumberOfPoints() == 0)
  {
    return false;
  }
  goTo(last.Hit, -StrokeClearance);
  this->Path = Polyline(points, nullptr);
  return true;
}

void DeviceChoice::FollowPath(vtkMatrix4x4* deviceToWorld)
{
  if (this->Chosen)
  {
    this->Chosen->StartInFront(); // what is new is approached from there
  }
  if (!this->Path)
  {
    return;
  }
  vtkNew<vtkMatrix4x4> toDevice;
  vtkMatrix4x4::Invert(deviceToWorld, toDevice);
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (vtkIdType i = 0; i < this->Path->GetNumberOfPoints(); ++i)
  {
    double point[4] = { 0.0, 0.0, 0.0, 1.0 };
    this->Path->GetPoint(i, point);
    toDevice->MultiplyPoint(point, point);
    points->InsertNextPoint(point);
  }
  this->Chosen->FollowPath(
    Polyline(points, this->Path->GetPointData()->GetArray("Time")), StrokeSpeed, this->MakesStroke);
}
}
