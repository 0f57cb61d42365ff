#ifndef Haptics_RealSurface_h
#define Haptics_RealSurface_h

#include "haptics/Surface/TriangleSurface.h"

#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include <ostream>
#include <string>

namespace haptics::testing
{
/// A surface that Data/get_surfaces.py gets, and what is known of it from elsewhere.
struct RealSurface
{
  const char* File;
  vtkIdType Triangles;
  vtkIdType Components;
  vtkIdType NonManifoldEdges;
  vtkIdType FlippedEdges;
  bool Closed;
  int Genus; ///< of all components together; -1: not defined or not known
  /// Ticks in each stroke: fewer where checking one takes long.
  int Ticks = 300;
};

inline std::ostream& operator<<(std::ostream& out, const RealSurface& surface)
{
  return out << surface.File;
}

/// The path of the file, or an empty string where it could not be got.
std::string PathOf(const RealSurface& surface);

/// Reads a .stl or .vtp file. Null when that fails.
vtkSmartPointer<vtkPolyData> Read(const std::string& path);
}

#endif
