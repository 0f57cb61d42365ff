#include "vtkPVHapticScene.h"

#include "HapticDeviceChoice.h"
#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkCellData.h"
#include "vtkCommand.h"
#include "vtkCompositeRepresentation.h"
#include "vtkGodObjectActor.h"
#include "vtkGodObjectFilter.h"
#include "vtkHapticLandmarks.h"
#include "vtkHapticOverlay.h"
#include "vtkHapticProbe.h"
#include "vtkHapticScene.h"
#include "vtkHapticServo.h"
#include "vtkHapticSurfaceRepresentation.h"
#include "vtkMath.h"
#include "vtkMatrix4x4.h"
#include "vtkMouseHapticDevice.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPVRenderView.h"
#include "vtkPointData.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkSmartPointer.h"
#include "vtkStringArray.h"
#include "vtkWeakPointer.h"

#include <algorithm>
#include <set>
#include <sstream>
#include <vector>

vtkStandardNewMacro(vtkPVHapticScene);

class vtkPVHapticScene::Internals
{
public:
  struct Surface
  {
    vtkWeakPointer<vtkObject> Representation;
    vtkSmartPointer<vtkActor> Actor; // null while it cannot be touched
    int Id = -1;                     // in the scene
  };

  vtkNew<vtkHapticScene> Scene;
  vtkWeakPointer<vtkPVRenderView> View;
  vtkWeakPointer<vtkRenderer> Renderer; // that shows the hand
  vtkWeakPointer<vtkRenderer> OverlayRenderer;
  std::vector<unsigned long> ViewObservers;
  std::vector<Surface> Surfaces;
  std::string DeviceName = "mouse";
  haptics::DeviceChoice Choice;
  bool Fitted = false;
  bool Wanted = false; // engaged, or about to be when the device is ready
  int Side = vtkGodObjectFilter::AUTOMATIC_SIDE;
  double MaximumForce = 3.3;
  std::string Message;
  std::string State;
  std::string ShownState;
  vtkNew<vtkStringArray> Probed;

  static vtkHapticSurfaceRepresentation* Active(vtkObject* representation)
  {
    if (auto* composite = vtkCompositeRepresentation::SafeDownCast(representation))
    {
      representation = composite->GetActiveRepresentation();
    }
    return vtkHapticSurfaceRepresentation::SafeDownCast(representation);
  }

  void Show(vtkRenderer* renderer)
  {
    vtkGodObjectActor* hand = this->Scene->GetGodObjectActor();
    if (renderer != this->Renderer)
    {
      if (this->Renderer)
      {
        this->Renderer->RemoveViewProp(hand);
      }
      if (renderer)
      {
        renderer->AddViewProp(hand);
      }
      this->Renderer = renderer;
    }
  }

  /// Where the picture is drawn on a server only the non-composited renderer draws here.
  void OnRender()
  {
    if (this->View)
    {
      const bool remote = this->View->GetUsedLODForLastRender()
        ? this->View->GetUseDistributedRenderingForLODRender()
        : this->View->GetUseDistributedRenderingForRender();
      this->Show(remote ? this->View->GetNonCompositedRenderer() : this->View->GetRenderer());
      this->Scene->GetGodObjectActor()->IncludeInClippingRange(this->Renderer);
    }
  }
};

vtkPVHapticScene::vtkPVHapticScene()
  : Internal(std::make_unique<Internals>())
{
  this->Internal->Scene->GetServo()->SetMaximumForce(this->Internal->MaximumForce);
}

vtkPVHapticScene::~vtkPVHapticScene()
{
  this->SetView(nullptr);
}

void vtkPVHapticScene::Fail(const std::string& message)
{
  this->Internal->Message = message;
  vtkErrorMacro(<< message);
}

vtkHapticScene* vtkPVHapticScene::GetScene()
{
  return this->Internal->Scene;
}

//--- view -----------------------------------------------------------------------------------------

vtkPVRenderView* vtkPVHapticScene::GetView()
{
  return this->Internal->View;
}

void vtkPVHapticScene::SetView(vtkObject* object)
{
  vtkPVRenderView* view = vtkPVRenderView::SafeDownCast(object);
  if (object && !view)
  {
    this->Fail("A view of the kind " + std::string(object->GetClassName()) +
      " cannot be touched. Activate a render view.");
  }
  Internals& self = *this->Internal;
  if (view == self.View && view)
  {
    return;
  }
  this->SetEngaged(false);
  if (self.View)
  {
    self.Show(nullptr);
    if (self.OverlayRenderer)
    {
      self.OverlayRenderer->RemoveViewProp(self.Scene->GetOverlay());
    }
    self.View->GetRenderWindow()->RemoveObserver(self.ViewObservers.at(0));
    self.View->RemoveObserver(self.ViewObservers.at(1));
    self.ViewObservers.clear();
  }
  self.View = view;
  if (auto* mouse = vtkMouseHapticDevice::SafeDownCast(self.Scene->GetDevice()))
  {
    mouse->SetInteractor(view ? view->GetInteractor() : nullptr);
  }
  if (view)
  {
    self.OverlayRenderer = view->GetNonCompositedRenderer();
    self.OverlayRenderer->AddViewProp(self.Scene->GetOverlay());
    self.Show(view->GetRenderer());
    self.ViewObservers = { view->GetRenderWindow()->AddObserver(
                             vtkCommand::StartEvent, &self, &Internals::OnRender),
      view->AddObserver(vtkCommand::DeleteEvent, this, &vtkPVHapticScene::OnViewDeleted) };
  }
  this->Modified();
}

void vtkPVHapticScene::OnViewDeleted()
{
  // Its window and renderers go with it, and our props in them.
  Internals& self = *this->Internal;
  self.View = nullptr;
  self.ViewObservers.clear();
  if (self.Wanted)
  {
    this->SetEngaged(false);
    this->Fail("The view was closed; the device is released.");
  }
}

//--- surfaces -------------------------------------------------------------------------------------

void vtkPVHapticScene::AddSurface(vtkObject* representation)
{
  if (!vtkCompositeRepresentation::SafeDownCast(representation) &&
    !vtkHapticSurfaceRepresentation::SafeDownCast(representation))
  {
    this->Fail(std::string(representation ? representation->GetClassName() : "Nothing") +
      " has no surface to touch. Give a representation of a render view.");
    return;
  }
  Internals::Surface surface;
  surface.Representation = representation;
  this->Internal->Surfaces.push_back(surface);
  this->Modified();
}

void vtkPVHapticScene::RemoveAllSurfaces()
{
  this->Internal->Surfaces.clear();
  this->Modified();
}

void vtkPVHapticScene::SyncSurfaces()
{
  Internals& self = *this->Internal;
  std::set<vtkActor*> wanted;
  for (Internals::Surface& surface : self.Surfaces)
  {
    vtkHapticSurfaceRepresentation* representation = Internals::Active(surface.Representation);
    surface.Actor = representation ? representation->GetTouchedActor() : nullptr;
    surface.Id = -1;
    if (surface.Actor)
    {
      wanted.insert(surface.Actor);
      surface.Id = self.Scene->AddSurface(surface.Actor);
      self.Scene->GetSurfaceFilter(surface.Id)->SetSide(self.Side);
    }
  }
  for (int i = self.Scene->GetNumberOfSurfaces() - 1; i >= 0; --i)
  {
    const int id = self.Scene->GetSurfaceId(i);
    if (wanted.count(self.Scene->GetSurfaceActor(id)) == 0)
    {
      self.Scene->RemoveSurface(id);
    }
  }
}

int vtkPVHapticScene::GetNumberOfTouchableSurfaces()
{
  int touchable = 0;
  for (const Internals::Surface& surface : this->Internal->Surfaces)
  {
    touchable += this->Internal->Scene->IsSurfaceTouchable(surface.Id) ? 1 : 0;
  }
  return touchable;
}

void vtkPVHapticScene::SetSide(int side)
{
  this->Internal->Side = std::clamp(
    side, static_cast<int>(vtkGodObjectFilter::FRONT), +vtkGodObjectFilter::AUTOMATIC_SIDE);
  this->Modified();
}

int vtkPVHapticScene::GetSide()
{
  return this->Internal->Side;
}

//--- device ---------------------------------------------------------------------------------------

void vtkPVHapticScene::SetDeviceName(const char* name)
{
  const std::string wanted = name ? name : "";
  if (wanted != this->Internal->DeviceName)
  {
    this->SetEngaged(false);
    this->Internal->Scene->SetDevice(nullptr);
    this->Internal->Choice = haptics::DeviceChoice();
    this->Internal->DeviceName = wanted;
    this->Internal->Message.clear();
    this->Modified();
  }
}

const char* vtkPVHapticScene::GetDeviceName()
{
  return this->Internal->DeviceName.c_str();
}

bool vtkPVHapticScene::ChooseDevice()
{
  Internals& self = *this->Internal;
  if (self.Choice.Device())
  {
    return true;
  }
  std::string error;
  self.Choice = haptics::DeviceChoice::Make(self.DeviceName, error);
  if (!self.Choice.Device())
  {
    this->Fail(error);
    return false;
  }
  self.Scene->SetDevice(self.Choice.Device());
  if (auto* mouse = vtkMouseHapticDevice::SafeDownCast(self.Choice.Device()))
  {
    mouse->SetScene(self.Scene);
    mouse->SetInteractor(self.View ? self.View->GetInteractor() : nullptr);
  }
  if (self.Choice.WorldPath() && self.Fitted)
  {
    self.Choice.FollowPath(self.Scene->GetWorkspaceTransform());
  }
  return true;
}

bool vtkPVHapticScene::Prepare()
{
  Internals& self = *this->Internal;
  if (!self.View)
  {
    this->Fail("There is no render view to touch in. Activate one.");
    return false;
  }
  if (self.Surfaces.empty())
  {
    this->Fail("There is nothing to touch. Select a source, show it as Haptic Surface.");
    return false;
  }
  return this->ChooseDevice() && (self.Fitted || this->Fit());
}

void vtkPVHapticScene::SetEngaged(bool engaged)
{
  Internals& self = *this->Internal;
  if (!engaged)
  {
    self.Wanted = false;
    self.Scene->Release();
    return;
  }
  if (self.Scene->IsEngaged())
  {
    return;
  }
  self.Message.clear();
  this->SyncSurfaces();
  if (!this->Prepare())
  {
    return;
  }
  self.Wanted = self.Scene->Engage();
  if (!self.Wanted)
  {
    const int state = self.Scene->GetDevice()->GetState();
    self.Wanted = state != vtkHapticDevice::Closed && state != vtkHapticDevice::Faulted &&
      state != vtkHapticDevice::Ready;
    self.Message = self.Scene->GetErrorMessage();
  }
}

bool vtkPVHapticScene::GetEngaged()
{
  return this->Internal->Scene->IsEngaged();
}

void vtkPVHapticScene::SetStiffness(double stiffness)
{
  this->Internal->Scene->SetStiffness(stiffness);
  this->Modified();
}

double vtkPVHapticScene::GetStiffness()
{
  return this->Internal->Scene->GetStiffness();
}

double vtkPVHapticScene::GetEffectiveStiffness()
{
  return this->Internal->Scene->GetServo()->GetEffectiveStiffness();
}

void vtkPVHapticScene::SetMaximumForce(double force)
{
  this->Internal->Scene->GetServo()->SetMaximumForce(force);
  this->Internal->MaximumForce = this->Internal->Scene->GetServo()->GetMaximumForce();
  this->Modified();
}

double vtkPVHapticScene::GetMaximumForce()
{
  return this->Internal->MaximumForce;
}

//--- workspace ------------------------------------------------------------------------------------

void vtkPVHapticScene::SetWorkspaceTransform(const double matrix[16])
{
  vtkNew<vtkMatrix4x4> transform;
  transform->DeepCopy(matrix);
  Internals& self = *this->Internal;
  if (self.Scene->SetWorkspaceTransform(transform))
  {
    self.Fitted = true;
    if (!self.Scene->IsEngaged())
    {
      self.Choice.FollowPath(transform);
    }
  }
  else
  {
    self.Message = self.Scene->GetErrorMessage();
  }
}

void vtkPVHapticScene::GetWorkspaceTransform(double matrix[16])
{
  std::copy_n(this->Internal->Scene->GetWorkspaceTransform()->GetData(), 16, matrix);
}

bool vtkPVHapticScene::Fit()
{
  Internals& self = *this->Internal;
  if (!self.View)
  {
    this->Fail("There is no render view to fit the device's workspace to. Activate one.");
    return false;
  }
  if (!this->ChooseDevice())
  {
    return false;
  }
  this->SyncSurfaces();
  vtkCamera* camera = self.View->GetActiveCamera();
  vtkPolyData* path = self.Choice.WorldPath();
  double bounds[6] = { 0.0, 0.0, 0.0, 0.0, 0.0, 0.0 };
  if (path && !self.Choice.Strokes())
  {
    path->GetBounds(bounds);
    self.Fitted = self.Scene->FitWorkspace(bounds, camera);
  }
  else
  {
    self.Fitted = self.Scene->FitWorkspace(camera);
  }
  if (!self.Fitted)
  {
    self.Message = self.Scene->GetErrorMessage();
    return false;
  }
  if (!self.Scene->IsEngaged())
  {
    if (!self.Choice.MakeStroke(self.Scene))
    {
      this->Fail(
        "The simulated hand finds no surface to stroke in the middle of the view. Turn the "
        "camera to one.");
      return false;
    }
    self.Choice.FollowPath(self.Scene->GetWorkspaceTransform());
  }
  return true;
}

void vtkPVHapticScene::ScaleWorkspace(double factor)
{
  if (!this->Internal->Scene->ScaleWorkspace(factor))
  {
    this->Internal->Message = this->Internal->Scene->GetErrorMessage();
  }
}

void vtkPVHapticScene::SetClutched(bool clutched)
{
  this->Internal->Scene->SetClutched(clutched);
}

bool vtkPVHapticScene::GetClutched()
{
  return this->Internal->Scene->GetClutched();
}

//--- running --------------------------------------------------------------------------------------

bool vtkPVHapticScene::Update()
{
  Internals& self = *this->Internal;
  this->SyncSurfaces();
  const bool wasEngaged = self.Scene->IsEngaged();
  bool changed = self.Scene->Update();
  if (wasEngaged && !self.Scene->IsEngaged())
  {
    self.Wanted = false;
    self.Message = self.Scene->GetErrorMessage();
    changed = true;
  }
  if (self.Wanted && !self.Scene->IsEngaged())
  {
    const int state = self.Scene->GetDevice()->GetState();
    if (state == vtkHapticDevice::Ready || state == vtkHapticDevice::Faulted)
    {
      this->SetEngaged(state == vtkHapticDevice::Ready);
      self.Message = self.Scene->GetErrorMessage();
    }
  }
  // What the panel says is part of the picture.
  if (self.ShownState != this->GetState())
  {
    self.ShownState = self.State;
    changed = true;
  }
  return changed;
}

void vtkPVHapticScene::Step(int ticks)
{
  this->Internal->Message.clear();
  this->SyncSurfaces();
  if (this->Prepare() && this->Internal->Scene->Step(ticks) < ticks)
  {
    this->Internal->Message = this->Internal->Scene->GetErrorMessage();
  }
}

void vtkPVHapticScene::SetRecordingFileName(const char* name)
{
  this->Internal->Scene->GetServo()->SetRecordingFileName(name ? name : "");
  this->Modified();
}

void vtkPVHapticScene::SetRecordTrace(bool record)
{
  if (record != this->GetRecordTrace())
  {
    record ? this->Internal->Scene->StartRecording() : this->Internal->Scene->StopRecording();
  }
}

bool vtkPVHapticScene::GetRecordTrace()
{
  return this->Internal->Scene->GetRecording();
}

void vtkPVHapticScene::DropLandmark()
{
  if (this->Internal->Scene->DropLandmark() < 0)
  {
    this->Internal->Message = this->Internal->Scene->GetErrorMessage();
  }
}

void vtkPVHapticScene::RemoveLastLandmark()
{
  this->Internal->Scene->GetLandmarks()->Undo();
}

void vtkPVHapticScene::ClearLandmarks()
{
  this->Internal->Scene->GetLandmarks()->RemoveAll();
}

int vtkPVHapticScene::GetNumberOfLandmarks()
{
  return this->Internal->Scene->GetLandmarks()->GetNumberOfLandmarks();
}

//--- what is told ---------------------------------------------------------------------------------

const char* vtkPVHapticScene::GetState()
{
  Internals& self = *this->Internal;
  vtkHapticScene* scene = self.Scene;
  if (scene->IsEngaged())
  {
    self.State = scene->GetClutched() ? "Engaged, clutched: nothing is touched"
      : scene->GetTouching()          ? "Engaged, touching"
                                      : "Engaged, in free space";
  }
  else if (self.Wanted)
  {
    self.State = scene->GetDevice()->GetStatusMessage();
  }
  else
  {
    self.State = self.Message.empty() ? "Released" : "Released: " + self.Message;
  }
  return self.State.c_str();
}

const char* vtkPVHapticScene::GetMessage()
{
  return this->Internal->Message.c_str();
}

double vtkPVHapticScene::GetRate()
{
  return this->GetEngaged() ? this->Internal->Scene->GetServo()->GetMeasuredRate() : 0.0;
}

vtkTypeInt64 vtkPVHapticScene::GetMissedTicks()
{
  return this->Internal->Scene->GetServo()->GetNumberOfMissedTicks();
}

double* vtkPVHapticScene::GetForce()
{
  return this->Internal->Scene->GetForce();
}

double vtkPVHapticScene::GetForceMagnitude()
{
  return vtkMath::Norm(this->GetForce());
}

double vtkPVHapticScene::GetPenetration()
{
  return this->Internal->Scene->GetPenetration();
}

double* vtkPVHapticScene::GetHapticInterfacePoint()
{
  return this->Internal->Scene->GetHapticInterfacePoint();
}

double* vtkPVHapticScene::GetGodObject()
{
  return this->Internal->Scene->GetGodObject();
}

bool vtkPVHapticScene::GetTouching()
{
  return this->Internal->Scene->GetTouching();
}

int vtkPVHapticScene::GetTouchedRepresentation()
{
  const int id = this->Internal->Scene->GetTouchedSurface();
  const std::vector<Internals::Surface>& surfaces = this->Internal->Surfaces;
  const auto found = std::find_if(surfaces.begin(), surfaces.end(),
    [id](const Internals::Surface& surface) { return id >= 0 && surface.Id == id; });
  return found == surfaces.end() ? -1 : static_cast<int>(found - surfaces.begin());
}

vtkIdType vtkPVHapticScene::GetTouchedCell()
{
  // ParaView's extraction of the surface has kept where each face came from.
  vtkHapticProbe* probe = this->Internal->Scene->GetProbe();
  vtkDataArray* ids = probe->GetCellValues()->GetArray("vtkOriginalCellIds");
  return probe->GetTouching() && ids && ids->GetNumberOfTuples() > 0
    ? static_cast<vtkIdType>(ids->GetComponent(0, 0))
    : this->Internal->Scene->GetTouchedCell();
}

vtkStringArray* vtkPVHapticScene::GetProbedValues()
{
  vtkStringArray* texts = this->Internal->Probed;
  texts->Initialize();
  vtkHapticProbe* probe = this->Internal->Scene->GetProbe();
  for (vtkFieldData* values : { static_cast<vtkFieldData*>(probe->GetPointValues()),
         static_cast<vtkFieldData*>(probe->GetCellValues()) })
  {
    for (int i = 0; probe->GetTouching() && i < values->GetNumberOfArrays(); ++i)
    {
      vtkAbstractArray* array = values->GetAbstractArray(i);
      std::ostringstream text;
      for (int c = 0; c < array->GetNumberOfComponents(); ++c)
      {
        text << (c ? ", " : "") << array->GetVariantValue(c).ToString();
      }
      texts->InsertNextValue(array->GetName() ? array->GetName() : "");
      texts->InsertNextValue(text.str());
    }
  }
  return texts;
}

void vtkPVHapticScene::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "View: " << this->Internal->View.Get() << "\n";
  os << indent << "Surfaces: " << this->Internal->Surfaces.size() << "\n";
  os << indent << "DeviceName: " << this->Internal->DeviceName << "\n";
  os << indent << "State: " << this->GetState() << "\n";
  os << indent << "Message: " << this->Internal->Message << "\n";
  os << indent << "Scene:\n";
  this->Internal->Scene->PrintSelf(os, indent.GetNextIndent());
}
