/**
 * @class   vtkHapticSceneParts
 * @brief   What a vtkHapticScene is made of, and hands out.
 *
 * | part | is |
 * | --- | --- |
 * | GetSurfaces() | each surface by its id: name, filter, material, whether it can be touched,
 * builds | | GetWorkspace() | where the reach of the device lies in the world: transform, fit,
 * scale, clutch | | GetGrip() | what the hand carries | | GetTraceRecorder() | the trace of the
 * ticks, which come with the scene's Update() and Step() | | GetLandmarks() | the points that the
 * hand has marked | | GetServo() | the loop: rate, statistics, priority. Its device and surfaces
 * are the scene's business |
 *
 * None of them is ever null; they live as long as the scene, and belong to it.
 *
 * The other methods are shortcuts, kept for the programs that call them: each does what the method
 * of the part does that it names. New ones go to the parts.
 *
 * GUI thread.
 *
 * @sa vtkHapticScene vtkHapticSurfaces vtkHapticWorkspace vtkHapticGrip vtkHapticTraceRecorder
 * vtkHapticLandmarks vtkHapticServo
 */
#ifndef Haptics_vtkHapticSceneParts_h
#define Haptics_vtkHapticSceneParts_h

#include "vtkHapticTraceRecorder.h"
#include "vtkHapticWorkspace.h"
#include "vtkHapticsSceneModule.h"
#include "vtkNew.h"
#include "vtkObject.h"

class vtkActor;
class vtkGodObjectFilter;
class vtkHapticGrip;
class vtkHapticLandmarks;
class vtkHapticProperties;
class vtkHapticServo;
class vtkHapticSurfaces;
class vtkMatrix4x4;
class vtkPolyData;

class VTKHAPTICSSCENE_EXPORT vtkHapticSceneParts : public vtkObject
{
public:
  vtkAbstractTypeMacro(vtkHapticSceneParts, vtkObject);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /** The parts: see above. */
  vtkHapticSurfaces* GetSurfaces() { return this->Surfaces; }
  vtkHapticWorkspace* GetWorkspace() { return this->Workspace; }
  vtkHapticGrip* GetGrip() { return this->Grip; }
  vtkHapticTraceRecorder* GetTraceRecorder() { return this->TraceRecorder; }
  vtkHapticLandmarks* GetLandmarks() { return this->Landmarks; }
  vtkHapticServo* GetServo() { return this->Servo; }
  ///@}

  ///@{
  /** Shortcuts: the methods of vtkHapticSurfaces. */
  int GetNumberOfSurfaces();
  vtkActor* GetSurfaceActor(int id);
  vtkGodObjectFilter* GetSurfaceFilter(int id);
  vtkHapticProperties* GetSurfaceProperties(int id);
  bool SetSurfacePropertyArray(int id, int property, int association, const char* name);
  bool IntersectRay(const double from[3], const double direction[3], double hit[3]);
  ///@}
  ///@{
  /** Shortcuts: the methods of vtkHapticWorkspace. */
  bool SetWorkspaceTransform(vtkMatrix4x4* deviceToWorld);
  vtkMatrix4x4* GetWorkspaceTransform() { return this->Workspace->GetTransform(); }
  bool ScaleWorkspace(double factor);
  void ResetWorkspace() { this->Workspace->Reset(); }
  void SetClutched(bool clutched) { this->Workspace->SetClutched(clutched); }
  bool GetClutched() { return this->Workspace->GetClutched(); }
  ///@}
  ///@{
  /** Shortcuts: the methods of vtkHapticTraceRecorder. */
  void StartRecording() { this->TraceRecorder->Start(); }
  void StopRecording() { this->TraceRecorder->Stop(); }
  vtkPolyData* GetTrace() { return this->TraceRecorder->GetTrace(); }
  ///@}

protected:
  vtkHapticSceneParts();
  ~vtkHapticSceneParts() override;

  /** The scene's message is that of the call that is about to be made. */
  virtual void ForgetMessage() = 0;

  vtkNew<vtkHapticServo> Servo;
  vtkNew<vtkHapticSurfaces> Surfaces;
  vtkNew<vtkHapticWorkspace> Workspace;
  vtkNew<vtkHapticGrip> Grip;
  vtkNew<vtkHapticTraceRecorder> TraceRecorder;
  vtkNew<vtkHapticLandmarks> Landmarks;

private:
  vtkHapticSceneParts(const vtkHapticSceneParts&) = delete;
  void operator=(const vtkHapticSceneParts&) = delete;
};

#endif
