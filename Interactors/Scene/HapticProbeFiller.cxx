#include "haptics/Scene/HapticProbeFiller.h"

#include "haptics/Filters/DataPoints.h"
#include "haptics/Scene/FieldValues.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkIdList.h"
#include "vtkMath.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <cmath>

namespace
{
/// The weights of the triangle's point nearest to where `p` falls on its plane, within it.
void FindWeights(const haptics::Vec3& p, const haptics::Vec3 corners[3], double weights[3])
{
  double u[3];
  double v[3];
  double w[3];
  vtkMath::Subtract(corners[1].data(), corners[0].data(), u);
  vtkMath::Subtract(corners[2].data(), corners[0].data(), v);
  vtkMath::Subtract(p.data(), corners[0].data(), w);
  const double uu = vtkMath::Dot(u, u);
  const double uv = vtkMath::Dot(u, v);
  const double vv = vtkMath::Dot(v, v);
  const double uw = vtkMath::Dot(u, w);
  const double vw = vtkMath::Dot(v, w);
  const double determinant = uu * vv - uv * uv;
  weights[1] = determinant > 0.0 ? (vv * uw - uv * vw) / determinant : 0.0;
  weights[2] = determinant > 0.0 ? (uu * vw - uv * uw) / determinant : 0.0;
  weights[0] = 1.0 - weights[1] - weights[2];
  double sum = 0.0;
  for (int i = 0; i < 3; ++i)
  {
    weights[i] = std::max(0.0, weights[i]);
    sum += weights[i];
  }
  vtkMath::MultiplyScalar(weights, 1.0 / sum);
}

/// Makes zero of what rounding has left of it between values of both signs.
void DropRounding(
  vtkPointData* result, vtkPointData* corners, vtkIdList* ids, const double weights[3])
{
  constexpr double rounding = 1e-14; // of the values
  for (int i = 0; i < result->GetNumberOfArrays(); ++i)
  {
    vtkDataArray* const values = result->GetArray(i);
    const bool isNamed = values && values->GetName();
    vtkDataArray* const given = isNamed ? corners->GetArray(values->GetName()) : nullptr;
    if (!given)
    {
      continue;
    }
    for (int c = 0; c < values->GetNumberOfComponents(); ++c)
    {
      double most = 0.0;
      for (int corner = 0; corner < 3; ++corner)
      {
        most += weights[corner] * std::abs(given->GetComponent(ids->GetId(corner), c));
      }
      if (std::abs(values->GetComponent(0, c)) < rounding * most)
      {
        values->SetComponent(0, c, 0.0);
      }
    }
  }
}
}

void vtkHapticProbeFiller::SetTick(vtkHapticProbe* probe, const haptics::TickRecord& tick)
{
  probe->Time = tick.Time;
  probe->Penetration = tick.NumberOfConstraints > 0 ? tick.Penetration : 0.0;
  std::copy(tick.Hip.begin(), tick.Hip.end(), probe->HapticInterfacePoint);
  std::copy(tick.Position.begin(), tick.Position.end(), probe->Position);
  std::copy(tick.WorldForce.begin(), tick.WorldForce.end(), probe->Force);
}

void vtkHapticProbeFiller::SetContact(vtkHapticProbe* probe, const haptics::TickRecord& tick,
  const SurfaceCell& touched, vtkPolyData* prepared)
{
  const std::shared_ptr<const haptics::TriangleSurface>& surface = touched.Snapshot;
  const haptics::Constraint& constraint = tick.Constraints[0];
  const auto t = static_cast<std::size_t>(constraint.Triangle);
  probe->Touching = true;
  probe->Surface = touched.Surface;
  probe->SurfaceName = touched.SurfaceName;
  probe->Cell = touched.Cell;
  std::copy(constraint.Normal.begin(), constraint.Normal.end(), probe->Normal);

  const haptics::Triangle& triangle = surface->Triangles()[t];
  haptics::Vec3 corners[3];
  for (std::size_t i = 0; i < 3; ++i)
  {
    corners[i] = surface->PointAt(triangle[i], tick.DeformFraction);
  }
  FindWeights(tick.Local, corners, probe->Weights);
  haptics::Vec3 local{};
  haptics::Vec3 toTriangle{};
  for (std::size_t i = 0; i < 3; ++i)
  {
    const double along = probe->Weights[0] * corners[0][i] + probe->Weights[1] * corners[1][i] +
      probe->Weights[2] * corners[2][i];
    local[i] = surface->Origin()[i] + along;
    toTriangle[i] = along - tick.Local[i];
  }
  // The way to the triangle is about as short as the clearance, so a pose that is a little older
  // or newer than the tick does as well. One that was never moved is given exactly.
  const bool isMoved = touched.Pose != haptics::RigidPose();
  const haptics::Vec3 turned = touched.Pose.VectorToWorld(toTriangle);
  for (std::size_t i = 0; i < 3; ++i)
  {
    probe->Position[i] = isMoved ? tick.Position[i] + turned[i] : local[i];
  }
  haptics::RigidPose pose = touched.Pose;
  const haptics::Vec3 turnedLocal = pose.VectorToWorld(local);
  for (std::size_t i = 0; isMoved && i < 3; ++i)
  {
    pose.Translation[i] = probe->Position[i] - turnedLocal[i];
  }
  probe->Where = { surface, constraint.Triangle, local, pose,
    { probe->Weights[0], probe->Weights[1], probe->Weights[2] } };

  if (!prepared ||
    prepared->GetNumberOfPolys() != static_cast<vtkIdType>(surface->Triangles().size()))
  {
    return;
  }
  vtkNew<vtkIdList> ids;
  prepared->GetPolys()->GetCellAtId(constraint.Triangle, ids);
  // A mirrored actor's surface has the corners in another order than its geometry.
  const bool mirrored = haptics::HasExchangedCorners(prepared, *surface);
  const double weights[3] = { probe->Weights[0], probe->Weights[mirrored ? 2 : 1],
    probe->Weights[mirrored ? 1 : 2] };
  vtkDataArray* original = prepared->GetPointData()->GetArray("OriginalPointId");
  for (int i = 0; i < 3; ++i)
  {
    probe->Weights[i] = weights[i];
    probe->PointIds[i] =
      original ? static_cast<vtkIdType>(original->GetComponent(ids->GetId(i), 0)) : ids->GetId(i);
  }
  probe->PointValues->CopyAllOn();
  probe->PointValues->InterpolateAllocate(prepared->GetPointData(), 1);
  probe->PointValues->InterpolatePoint(prepared->GetPointData(), 0, ids, probe->Weights);
  probe->PointValues->RemoveArray("OriginalPointId");
  DropRounding(probe->PointValues, prepared->GetPointData(), ids, probe->Weights);
  probe->CellValues->CopyAllOn();
  probe->CellValues->CopyAllocate(prepared->GetCellData(), 1);
  probe->CellValues->CopyData(prepared->GetCellData(), constraint.Triangle, 0);
  probe->CellValues->RemoveArray("OriginalCellId");
}

void vtkHapticProbeFiller::Save(vtkHapticProbe* probe, vtkPolyData* record)
{
  record->Initialize();
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  const vtkIdType point = points->InsertNextPoint(probe->Position);
  vtkNew<vtkCellArray> verts;
  verts->InsertNextCell(1, &point);
  record->SetPoints(points);
  record->SetVerts(verts);
  record->GetPointData()->ShallowCopy(probe->PointValues);
  record->GetCellData()->ShallowCopy(probe->CellValues);
  haptics::FieldValues values(record->GetFieldData());
  values.Set("SurfaceName", probe->SurfaceName);
  values.Set("Cell", &probe->Cell, 1);
  values.Set("PointIds", probe->PointIds, 3);
  values.Set("Weights", probe->Weights, 3);
  values.Set("Normal", probe->Normal, 3);
  values.Set("Force", probe->Force, 3);
  values.Set("HapticInterfacePoint", probe->HapticInterfacePoint, 3);
  values.Set("Penetration", &probe->Penetration, 1);
  values.Set("Time", &probe->Time, 1);
  const auto triangle = static_cast<vtkIdType>(probe->Where.Triangle);
  values.Set("Triangle", &triangle, 1);
  values.Set("TriangleWeights", probe->Where.Weights.data(), 3);
}

bool vtkHapticProbeFiller::Load(vtkPolyData* record, vtkHapticProbe* probe)
{
  const haptics::FieldValues values(record->GetFieldData());
  const bool isWhole = record->GetNumberOfPoints() == 1 && record->GetNumberOfVerts() == 1 &&
    values.Get("SurfaceName", probe->SurfaceName) && values.Get("Cell", &probe->Cell, 1) &&
    values.Get("PointIds", probe->PointIds, 3) && values.Get("Weights", probe->Weights, 3) &&
    values.Get("Normal", probe->Normal, 3) && values.Get("Force", probe->Force, 3) &&
    values.Get("HapticInterfacePoint", probe->HapticInterfacePoint, 3) &&
    values.Get("Penetration", &probe->Penetration, 1) && values.Get("Time", &probe->Time, 1) &&
    values.Get("Triangle", &probe->Where.Triangle, 1) &&
    values.Get("TriangleWeights", probe->Where.Weights.data(), 3);
  if (isWhole)
  {
    record->GetPoint(0, probe->Position);
    probe->PointValues->ShallowCopy(record->GetPointData());
    probe->CellValues->ShallowCopy(record->GetCellData());
    probe->Touching = true;
  }
  return isWhole;
}
