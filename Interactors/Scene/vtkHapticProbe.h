/**
 * @class   vtkHapticProbe
 * @brief   What lies at a contact: which cell, where in it, and every array's value there.
 *
 * A vtkHapticScene fills one at each contact: it is the call data of its contact events, and
 * GetProbe() has the latest. One that an event brought stays as it is, so it can be kept.
 *
 * Point arrays are interpolated between the three corners of the triangle with the weights below
 * (whole numbers are rounded, text is that of the nearest corner); cell arrays are those of the
 * cell. Ids are those of the geometry as it was given to the scene, before triangulation.
 *
 * Positions are in the world frame [world unit], forces along the world's axes [N]. GUI thread.
 *
 * @sa vtkHapticScene vtkHapticLandmarks
 */
#ifndef Haptics_vtkHapticProbe_h
#define Haptics_vtkHapticProbe_h

#include "vtkHapticsSceneModule.h"
#include "vtkNew.h"
#include "vtkObject.h"

#include <string>

#ifndef __VTK_WRAP__
#include "haptics/Math/RigidPose.h"          // for haptics::RigidPose
#include "haptics/Surface/TriangleSurface.h" // for haptics::TriangleSurface

#include <memory>
#endif

class vtkCellData;
class vtkPointData;

class VTKHAPTICSSCENE_EXPORT vtkHapticProbe : public vtkObject
{
public:
  static vtkHapticProbe* New();
  vtkTypeMacro(vtkHapticProbe, vtkObject);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /** Whether there is a contact; where not, ids are -1 and there are no values. */
  vtkGetMacro(Touching, bool);
  vtkGetMacro(Time, double); ///< of the tick [s] since the servo's start
  vtkGetMacro(Surface, int); ///< id in the scene
  /** Its name (vtkHapticSurfaces::SetName()); where it has none, "surface" and the id. */
  std::string GetSurfaceName();
  vtkGetMacro(Cell, vtkIdType); ///< id of the cell as it was given
  /** Id of a corner of the triangle as it was given, corner 0 to 2; -1 elsewhere. */
  vtkIdType GetPointId(int corner);
  /** Weight of a corner, corner 0 to 2: the barycentric position. They are >= 0 and sum up to 1. */
  double GetWeight(int corner);
  vtkGetVector3Macro(Weights, double);  ///< all three
  vtkGetVector3Macro(Position, double); ///< exactly on the triangle
  vtkGetVector3Macro(Normal, double);   ///< unit, of the surface, towards the god-object
  vtkGetVector3Macro(Force, double);    ///< on the hand
  vtkGetVector3Macro(HapticInterfacePoint, double);
  vtkGetMacro(Penetration, double); ///< [world unit]

  ///@{
  /** One tuple of every point array and of every cell array; never null. */
  vtkPointData* GetPointValues();
  vtkCellData* GetCellValues();
  ///@}
  /** The first component of an array of either kind, points first; NaN where there is none. */
  double GetValue(const char* array);

  /**
   * Some lines of text: surface, cell, position, values. Empty where there is no contact. The cell
   * is that of the data from which a filter extracted the surface, where that kept
   * vtkOriginalCellIds; arrays whose names begin with "vtk" are left out.
   */
  std::string GetText();

#ifndef __VTK_WRAP__
  /** The contact on the surface itself, in C++ only. */
  struct Contact
  {
    std::shared_ptr<const haptics::TriangleSurface> Surface; ///< in a frame of its own
    int Triangle = -1;                                       ///< of it
    haptics::Vec3 Position{};                                ///< GetPosition() in that frame
    haptics::RigidPose Pose;                                 ///< from that frame to the world
    haptics::Vec3 Weights{};                                 ///< of its triangle's corners
  };
  const Contact& GetContact() const
  {
    return this->Where;
  }
#endif

protected:
  vtkHapticProbe();
  ~vtkHapticProbe() override;

private:
  vtkHapticProbe(const vtkHapticProbe&) = delete;
  void operator=(const vtkHapticProbe&) = delete;

  friend class vtkHapticProbeFiller;

  bool Touching = false;
  double Time = 0.0;
  int Surface = -1;
  std::string SurfaceName;
  vtkIdType Cell = -1;
  vtkIdType PointIds[3] = { -1, -1, -1 };
  double Weights[3] = { 0.0, 0.0, 0.0 };
  double Position[3] = { 0.0, 0.0, 0.0 };
  double Normal[3] = { 0.0, 0.0, 0.0 };
  double Force[3] = { 0.0, 0.0, 0.0 };
  double HapticInterfacePoint[3] = { 0.0, 0.0, 0.0 };
  double Penetration = 0.0;
  vtkNew<vtkPointData> PointValues;
  vtkNew<vtkCellData> CellValues;
#ifndef __VTK_WRAP__
  Contact Where;
#endif
};

#endif
