/**
 * @class   vtkSMHapticSceneProxy
 * @brief   The proxy of a vtkPVHapticScene: keeps up with what is deleted, saved and traced
 *
 * A view or representation that is unregistered leaves the scene at once, as does everything when
 * the server is lost; state files get the workspace transform that is in force and the landmarks
 * that there are, as undo does where UpdateVTKObjects() is called after a change; surfaces are
 * named as the pipeline browser names their sources; the hand is shown in each view that shows a
 * surface in it, with what the servo has done until then; and while ParaView traces, each change of
 * a property becomes a line of Python, the first with all that counts. Another scene that is
 * registered in the session, by a state file, takes the place of this one, which is unregistered.
 *
 * GUI thread.
 *
 * @sa vtkPVHapticScene
 */
#ifndef Haptics_vtkSMHapticSceneProxy_h
#define Haptics_vtkSMHapticSceneProxy_h

#include "vtkHapticsRepresentationsModule.h"
#include "vtkSMProxy.h"
#include "vtkWeakPointer.h"

#include <set>
#include <string>
#include <vector>

class vtkPVHapticScene;
class vtkSMTrace;

class VTKHAPTICSREPRESENTATIONS_EXPORT vtkSMHapticSceneProxy : public vtkSMProxy
{
public:
  static vtkSMHapticSceneProxy* New();
  vtkTypeMacro(vtkSMHapticSceneProxy, vtkSMProxy);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /** The scene itself; null for the prototype. */
  vtkPVHapticScene* GetScene();

  /** Takes over what the proxy of a vtkHapticSettings has, but for an empty device. */
  void TakeSettings(vtkSMProxy* settings);

  void UpdateVTKObjects() override;
  void UpdatePropertyInformation() override;
  void UpdatePropertyInformation(vtkSMProperty* property) override;
  using vtkSMProxy::SaveXMLState;
  vtkPVXMLElement* SaveXMLState(vtkPVXMLElement* root, vtkSMPropertyIterator* iterator) override;

protected:
  vtkSMHapticSceneProxy();
  ~vtkSMHapticSceneProxy() override;

  void CreateVTKObjects() override;

private:
  vtkSMHapticSceneProxy(const vtkSMHapticSceneProxy&) = delete;
  void operator=(const vtkSMHapticSceneProxy&) = delete;

  void OnRegistered(vtkObject* caller, unsigned long event, void* information);
  void OnUnregistered(vtkObject* caller, unsigned long event, void* information);
  void GiveWay();
  void OnConnectionLost();
  void OnViewStart(vtkObject* caller, unsigned long event, void* information);
  void FollowView(vtkSMProxy* proxy);
  void ShowHandIn(vtkSMProxy* view);
  void ShowHand();
  void OnPropertyModified(vtkObject* caller, unsigned long event, void* name);
  void SyncWorkspace();
  void SyncLandmarks();
  void NameSurfaces(vtkSMProxy* source, const char* name);
  void TraceFromHereOn();
  void Trace();

  std::set<std::string> Untraced; // properties that have changed since the last update
  vtkMTimeType LandmarksTime = 0; // when they were as their property says
  std::vector<vtkWeakPointer<vtkSMProxy>> Views; // whose renders are followed
  vtkWeakPointer<vtkSMTrace> TracedTo;           // the tracer that imports what the lines need
};

#endif
