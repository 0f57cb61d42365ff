#ifndef Haptics_MeshToPolyData_h
#define Haptics_MeshToPolyData_h

#include "haptics/Surface/TriangleSurface.h"

#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

namespace haptics::testing
{
/// The triangles with points in double precision, and back. Only triangles come back.
vtkSmartPointer<vtkPolyData> ToPolyData(const TriangleMesh& mesh);
TriangleMesh ToMesh(vtkPolyData* polyData);
}

#endif
