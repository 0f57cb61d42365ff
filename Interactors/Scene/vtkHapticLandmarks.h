/**
 * @class   vtkHapticLandmarks
 * @brief   Points marked by touch, each exactly on a surface: a list, its export, their distances.
 *
 * A vtkHapticScene drops one where the hand touches, on a button of the device or on request. They
 * stay on the surface while that moves, is scaled or deforms, as of the scene's last Update().
 * Where its cells change, or it is hidden or goes away, they stay where they were last.
 *
 * Positions and lengths are in the world frame [world unit]. GUI thread.
 *
 * @sa vtkHapticScene vtkHapticProbe
 */
#ifndef Haptics_vtkHapticLandmarks_h
#define Haptics_vtkHapticLandmarks_h

#include "vtkHapticsSceneModule.h"
#include "vtkNew.h"
#include "vtkObject.h"
#include "vtkSmartPointer.h"

#include <string>
#include <vector>

namespace haptics
{
class SurfaceSet;
}

class vtkHapticProbe;
class vtkPolyData;

class VTKHAPTICSSCENE_EXPORT vtkHapticLandmarks : public vtkObject
{
public:
  static vtkHapticLandmarks* New();
  vtkTypeMacro(vtkHapticLandmarks, vtkObject);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /**
   * Marks where a probe touches, and returns the landmark's number, from 0; -1 and an error where
   * it touches nothing. The label is "1", "2", ... unless one is given.
   */
  int Drop(vtkHapticProbe* probe, const char* label = nullptr);
  /** Takes the last one away; false where there is none. */
  bool Undo();
  /** Takes one away; those after it move up. False where there is no such number. */
  bool Remove(int number);
  void RemoveAll();

  ///@{
  /**
   * A landmark as polydata with one point, to be kept in a file, with all that GetOutput() and
   * WriteCSV() have of it; an error where there is no such number. And such a one added at the end,
   * with its label, which returns its number; -1 and an error for other polydata. It lies where it
   * was, and belongs to no surface (-1), until the scene has a surface of the name of that on which
   * it was dropped, with the triangle that was touched: then it stays on that. Where no surface has
   * that name, the only one with that triangle at the landmark's place is it, renamed.
   */
  void GetRecord(int number, vtkPolyData* record);
  int Add(vtkPolyData* record);
  ///@}

  int GetNumberOfLandmarks();
  /** How many of them came out of records and have found no surface; as of the last Update(). */
  int GetNumberOfFreeLandmarks();
  /** What was touched, then; null where there is no such number. Not to be changed. */
  vtkHapticProbe* GetLandmark(int number);
  /** Where it is now. Zeros and an error where there is no such number. */
  void GetPosition(int number, double position[3]);
  ///@{
  /** The label; empty, or an error, where there is no such number. */
  std::string GetLabel(int number);
  void SetLabel(int number, const char* label);
  ///@}

  /** Between two landmarks as the crow flies [world unit]; NaN and an error without them. */
  double GetStraightDistance(int first, int second);
  /**
   * Between two landmarks along the surface that both were dropped on [world unit], as the surface
   * is now: a shortest way over its triangles, exact within those that
   * it crosses, and never shorter than the shortest of all. Against known lengths (a prism of thin
   * triangles, a sphere) it was at most 0.4 % longer. Infinite where the surface's parts do not
   * hang together; NaN and an error where they lie on two surfaces, or the surface's cells changed
   * in between. Takes about as long as building the surface did. `path`, where given, becomes the
   * way as a polyline.
   */
  double GetGeodesicDistance(int first, int second, vtkPolyData* path = nullptr);

  enum DistanceType
  {
    NO_DISTANCE,
    STRAIGHT,
    ALONG_SURFACE
  };
  ///@{
  /**
   * Which distance to the landmark before GetText() and a view give, a DistanceType: none, that of
   * GetStraightDistance() (the default), or that of GetGeodesicDistance(). The last is computed
   * once for each pair, and again for each deformation of the surface that both are on.
   */
  vtkSetClampMacro(Distance, int, NO_DISTANCE, ALONG_SURFACE);
  vtkGetMacro(Distance, int);
  ///@}
  /**
   * The distance to the landmark before [world unit], of the kind that is set; NaN of the first
   * one, without a kind, without a way along one surface, and, with an error, without such a
   * landmark.
   */
  double GetDistanceToPrevious(int number);
  /**
   * What a view writes next to a landmark: its label and the distance to the one before, in five
   * digits with its unit, as in "2: 0.04 m". An error where there is no such number.
   */
  std::string GetText(int number);

  /**
   * The landmarks as vertices with the point arrays Label, Text (see GetText()), Surface,
   * OriginalCellId, PointIds (3), Weights (3), Normal (3), Force (3), DistanceToPrevious, as the
   * crow flies, and, while Distance is ALONG_SURFACE, DistanceAlongSurface [world unit], both NaN
   * of the first. Made anew after each change; never null.
   */
  vtkPolyData* GetOutput();
  /**
   * Writes a table: label, x, y, z, surface, cell, point_0..2, weight_0..2, distance_to_previous
   * and a column for each array value. Names and labels that a spreadsheet would run as a formula
   * (=, +, - or @ first) get an apostrophe before them. Replaces a file of that name as a whole;
   * false and an error where it cannot be written, and then the old one stays.
   */
  bool WriteCSV(const char* file);

  ///@{
  /**
   * Length of a world unit [m], for the information of the output's arrays: the scene sets its own.
   * Default 0: not known.
   */
  void SetUnitLength(double metres);
  vtkGetMacro(UnitLength, double);
  ///@}

  ///@{
  /** The device's button that drops one where the hand touches. Default 0; -1 for none, to 31. */
  vtkSetClampMacro(Button, int, -1, 31);
  vtkGetMacro(Button, int);
  ///@}

#ifndef __VTK_WRAP__
  /** For the scene, C++ only: takes them to where the surfaces are now. */
  void Follow(const haptics::SurfaceSet& surfaces);
#endif

protected:
  vtkHapticLandmarks();
  ~vtkHapticLandmarks() override;

private:
  vtkHapticLandmarks(const vtkHapticLandmarks&) = delete;
  void operator=(const vtkHapticLandmarks&) = delete;

  struct Landmark;
  bool Has(int number);
  double StraightToPrevious(int number);
  double AlongSurfaceToPrevious(int number);
  bool AreOnOneSurface(int first, int second) const;
  double FindWay(int first, int second, vtkPolyData* path) const;

  std::vector<Landmark> Landmarks;
  int Distance = STRAIGHT;
  double UnitLength = 0.0;
  int Button = 0;
  int Dropped = 0; // for labels
  vtkNew<vtkPolyData> Output;
  vtkMTimeType OutputTime = 0;
};

#endif
