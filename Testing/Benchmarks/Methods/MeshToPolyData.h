#ifndef MeshToPolyData_h
#define MeshToPolyData_h

#include "TriangleSurface.h"

#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

namespace haptics::testing
{
/// The triangles with points in double precision, and back. Only triangles come back.
vtkSmartPointer<vtkPolyData> ToPolyData(const TriangleMesh& mesh);
TriangleMesh ToMesh(vtkPolyData* polyData);
}

#endif
