#ifndef Haptics_FilterTesting_h
#define Haptics_FilterTesting_h

#include "vtkCommand.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include <array>
#include <string>
#include <vector>

class vtkObject;

namespace testing_surfaces
{
using Point = std::array<double, 3>;
using Cells = std::vector<std::vector<vtkIdType>>;

struct Parts
{
  std::vector<Point> Points;
  Cells Polys;
  Cells Strips;
  Cells Lines;
  Cells Verts;
};

/// Points are stored as float64, or as float32 for `dataType` VTK_FLOAT.
vtkSmartPointer<vtkPolyData> MakePolyData(const Parts& parts, int dataType = VTK_DOUBLE);

/// A cube of edge 1 with one corner at the origin: six quads, normals outwards.
Parts Cube();

/// Sum over the triangles of area, and of the signed volume towards the origin.
double Area(vtkPolyData* triangles);
double Volume(vtkPolyData* triangles);

/// Collects the errors and warnings of an object, which then do not reach the console.
class MessageCatcher
{
public:
  explicit MessageCatcher(vtkObject* object);
  ~MessageCatcher();
  MessageCatcher(const MessageCatcher&) = delete;
  MessageCatcher& operator=(const MessageCatcher&) = delete;

  std::string Errors() const;
  std::string Warnings() const;

private:
  class Observer;
  vtkSmartPointer<vtkObject> Watched;
  vtkSmartPointer<Observer> Listener;
};
}

#endif
