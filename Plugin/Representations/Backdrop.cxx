#include "Backdrop.h"

#include "vtkCamera.h"
#include "vtkCollection.h"
#include "vtkCommand.h"
#include "vtkMatrix4x4.h"
#include "vtkOpenGLFramebufferObject.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLState.h"
#include "vtkRenderer.h"
#include "vtkRendererCollection.h"

#include <algorithm>
#include <vector>

namespace haptics
{
namespace
{
// Of OpenGL, whose header has another name with each VTK.
constexpr unsigned int ColorBit = 0x4000;    // GL_COLOR_BUFFER_BIT
constexpr unsigned int DepthBit = 0x0100;    // GL_DEPTH_BUFFER_BIT
constexpr unsigned int Nearest = 0x2600;     // GL_NEAREST
constexpr unsigned int ScissorTest = 0x0C11; // GL_SCISSOR_TEST
constexpr unsigned int DepthTest = 0x0B71;   // GL_DEPTH_TEST
constexpr int DepthBits = 24;                // as vtkOpenGLRenderWindow has them

/// Other renderers of a window that are drawn before one.
std::vector<vtkRenderer*> Behind(vtkRenderer* front)
{
  std::vector<vtkRenderer*> behind;
  vtkRendererCollection* const all = front->GetRenderWindow()->GetRenderers();
  for (int i = 0; i < all->GetNumberOfItems(); ++i)
  {
    auto* renderer = vtkRenderer::SafeDownCast(all->GetItemAsObject(i));
    if (renderer && renderer->GetDraw() && renderer->GetLayer() < front->GetLayer())
    {
      behind.push_back(renderer);
    }
  }
  return behind;
}
}

Backdrop::Backdrop() = default;

Backdrop::~Backdrop()
{
  this->SetRenderer(nullptr);
}

void Backdrop::SetRenderer(vtkRenderer* front)
{
  if (this->Front)
  {
    this->Front->RemoveObserver(this->Observer);
  }
  this->Front = front;
  this->IsKept = false;
  this->Picture = vtkSmartPointer<vtkOpenGLFramebufferObject>::New(); // one window's is no other's
  this->Size = { 0, 0 };
  if (front)
  {
    this->Observer = front->AddObserver(vtkCommand::StartEvent, this, &Backdrop::OnStart);
    if (vtkOpenGLRenderWindow* const window = this->Window())
    {
      window->MakeCurrent();
      window->GetState()->Reset(); // between renders OpenGL is the widget's, of Qt
      this->Keep();
    }
  }
}

vtkOpenGLRenderWindow* Backdrop::Window() const
{
  auto* window =
    vtkOpenGLRenderWindow::SafeDownCast(this->Front ? this->Front->GetRenderWindow() : nullptr);
  vtkOpenGLFramebufferObject* const drawn = window ? window->GetRenderFramebuffer() : nullptr;
  // Nothing is drawn yet while a state is loaded.
  const bool fits = drawn && !window->GetNeverRendered() && drawn->GetFBOIndex() != 0 &&
    drawn->GetMultiSamples() <= 1 && !window->GetStereoRender();
  return fits ? window : nullptr;
}

Backdrop::View Backdrop::Seen() const
{
  vtkMatrix4x4* const projection =
    this->Front->GetActiveCamera()->GetCompositeProjectionTransformMatrix(
      this->Front->GetTiledAspectRatio(), -1.0, 1.0);
  View seen;
  std::copy_n(projection->GetData(), seen.size(), seen.begin());
  return seen;
}

/// Before the renderer in front draws into the window's picture.
void Backdrop::OnStart()
{
  if (this->Drawing)
  {
    this->Copy(true);
    vtkOpenGLState* const state = this->Window()->GetState(); // as the renderer behind leaves it
    state->vtkglEnable(DepthTest);
    state->vtkglDepthMask(true);
    return;
  }
  const std::vector<vtkRenderer*> behind = Behind(this->Front);
  const bool isSelection = std::any_of(behind.begin(), behind.end(),
    [](vtkRenderer* renderer) { return renderer->GetSelector() != nullptr; });
  if (!isSelection) // that draws ids, not a picture
  {
    this->Keep();
  }
}

void Backdrop::Keep()
{
  this->IsKept = this->Copy(false);
  if (this->IsKept)
  {
    this->Camera = this->Seen();
  }
}

bool Backdrop::Copy(bool toWindow)
{
  vtkOpenGLRenderWindow* const window = this->Window();
  if (!window)
  {
    return false;
  }
  vtkOpenGLFramebufferObject* const drawn = window->GetRenderFramebuffer();
  int size[2];
  drawn->GetLastSize(size[0], size[1]);
  vtkOpenGLState* const state = window->GetState();
  state->PushFramebufferBindings();
  const bool isNew = this->Picture->GetFBOIndex() == 0;
  bool done = true;
  if (isNew || !std::equal(size, size + 2, this->Size.begin()))
  {
    done = !toWindow;
    this->Picture->SetContext(window);
    if (isNew)
    {
      done = done &&
        this->Picture->PopulateFramebuffer(size[0], size[1], true, 1, VTK_UNSIGNED_CHAR, true,
          DepthBits, 0, window->GetStencilCapable() != 0);
    }
    else
    {
      this->Picture->Resize(size[0], size[1]);
    }
    std::copy_n(size, 2, this->Size.begin());
  }
  if (done)
  {
    vtkOpenGLFramebufferObject* const from = toWindow ? this->Picture.Get() : drawn;
    vtkOpenGLFramebufferObject* const to = toWindow ? drawn : this->Picture.Get();
    const vtkOpenGLState::ScopedglEnableDisable scissors(state, ScissorTest);
    state->vtkglDisable(ScissorTest);
    from->Bind(vtkOpenGLFramebufferObject::GetReadMode());
    from->ActivateReadBuffer(0);
    to->Bind(vtkOpenGLFramebufferObject::GetDrawMode());
    to->ActivateDrawBuffer(0);
    const int extent[4] = { 0, size[0], 0, size[1] };
    vtkOpenGLFramebufferObject::Blit(extent, extent, ColorBit | DepthBit, Nearest);
  }
  state->PopFramebufferBindings();
  return done;
}

bool Backdrop::DrawFront()
{
  vtkOpenGLRenderWindow* const window = this->Window();
  const int* const size = window ? window->GetSize() : nullptr;
  if (!this->IsKept || !size || !std::equal(size, size + 2, this->Size.begin()) ||
    this->Seen() != this->Camera)
  {
    return false;
  }
  const std::vector<vtkRenderer*> behind = Behind(this->Front);
  for (vtkRenderer* renderer : behind)
  {
    renderer->DrawOff();
  }
  this->Drawing = true;
  window->Render();
  this->Drawing = false;
  for (vtkRenderer* renderer : behind)
  {
    renderer->DrawOn();
  }
  return true;
}
}
