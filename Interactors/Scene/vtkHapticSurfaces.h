/**
 * @class   vtkHapticSurfaces
 * @brief   The surfaces of a vtkHapticScene by their ids: what each is, and how they are built.
 *
 * A scene hands one out by vtkHapticScene::GetSurfaces(). Surfaces come and go by the scene's own
 * AddSurface() and RemoveSurface(); the ids are those that AddSurface() returns.
 *
 * Every method is for the GUI thread.
 *
 * @sa vtkHapticScene vtkGodObjectFilter vtkHapticProperties
 */
#ifndef Haptics_vtkHapticSurfaces_h
#define Haptics_vtkHapticSurfaces_h

#include "vtkHapticsSceneModule.h"
#include "vtkObject.h"

#include <memory>
#include <string>

namespace haptics
{
class BackgroundWorker;
class SurfaceSet;
}

class vtkActor;
class vtkAssembly;
class vtkGodObjectFilter;
class vtkHapticProperties;

class VTKHAPTICSSCENE_EXPORT vtkHapticSurfaces : public vtkObject
{
public:
  static vtkHapticSurfaces* New();
  vtkTypeMacro(vtkHapticSurfaces, vtkObject);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  int GetNumberOfSurfaces();
  /** The id of the i-th surface, 0 <= i < GetNumberOfSurfaces(); -1 elsewhere. */
  int GetId(int i);
  /** The actor of a surface; null where it was added as geometry, or there is no such id. */
  vtkActor* GetActor(int id);
  /** The assembly that a surface is a part of, or that has this id as a whole; null elsewhere. */
  vtkAssembly* GetAssembly(int id);
  /** The filter that prepares a surface: side, engine, report. Null where there is no such id. */
  vtkGodObjectFilter* GetFilter(int id);
  /** The material of a surface: friction, stiffness from data and so on. Null without such an id.
   */
  vtkHapticProperties* GetProperties(int id);
  /**
   * Chooses the data array of the surface that a property comes from (a number of
   * vtkHapticProperties::PropertyType), or the side of each cell (vtkGodObjectFilter::SIDE_ARRAY):
   * vtkDataObject::FIELD_ASSOCIATION_POINTS or _CELLS, and its name; none where that is null or
   * empty. False where there is no such id.
   */
  bool SetPropertyArray(int id, int property, int association, const char* name);
  ///@{
  /**
   * The name of a surface in the read-out, in messages and in traces. Default none: they then say
   * "surface" and its id. False where there is no such id; the name of none is "".
   */
  bool SetName(int id, const char* name);
  std::string GetName(int id);
  ///@}
  /** Whether a surface can be touched now: shown, not gripped, its geometry good at least once. */
  bool IsTouchable(int id);
  /**
   * Whether what is touched of a surface is older than what is shown, because its newest geometry
   * or matrix was rejected; the scene's error said why. The read-out says so while it is touched.
   */
  bool IsOutdated(int id);

  /**
   * Where a ray first meets a surface that can be touched, on a side that can be touched, and the
   * normal of the triangle there, of unit length and against the ray; world frame, `direction` of
   * any length. False, and the rest as it was, where it meets none.
   */
  bool IntersectRay(
    const double from[3], const double direction[3], double hit[3], double normal[3]);

  ///@{
  /**
   * Whether a surface whose geometry has changed is cleaned and built in the background, so that
   * the scene's Update() and Engage() return at once. Until it is built the older one stays in
   * force; what changes meanwhile is built next, in its newest state. Upstream filters still run on
   * the calling thread. Default off; the viewer and ParaView turn it on.
   *
   * A build works on a copy of the points, and shares the cells: code that writes into the memory
   * of a vtkCellArray, instead of replacing it as VTK's filters do, has to wait for IsBuilding() to
   * be false. vtkHapticScene::Step() waits for all builds, so that it gives the same result in
   * every run.
   */
  vtkSetMacro(BackgroundBuilding, bool);
  vtkGetMacro(BackgroundBuilding, bool);
  vtkBooleanMacro(BackgroundBuilding, bool);
  ///@}
  ///@{
  /**
   * Whether a surface is being built in the background, and the progress of all that are: 0 to 1,
   * and 1 where none is. As of the scene's last Update(), which takes in what is done.
   */
  bool IsBuilding();
  double GetBuildProgress();
  ///@}
  /** Gives up the builds: what is touched stays, until the geometry changes again. */
  void CancelBuild();

#ifndef __VTK_WRAP__
  ///@{
  /// For the scene, C++ only.
  haptics::SurfaceSet& GetSet();
  haptics::BackgroundWorker& GetWorker();
  ///@}
#endif

protected:
  vtkHapticSurfaces();
  ~vtkHapticSurfaces() override;

private:
  vtkHapticSurfaces(const vtkHapticSurfaces&) = delete;
  void operator=(const vtkHapticSurfaces&) = delete;

  std::unique_ptr<haptics::BackgroundWorker> Worker; // outlives the surfaces that give it work
  std::unique_ptr<haptics::SurfaceSet> Surfaces;
  bool BackgroundBuilding = false;
};

#endif
