/**
 * @class   vtkSMHapticSurfaceRepresentationProxy
 * @brief   The proxy of a vtkHapticSurfaceRepresentation: the material belongs to the source
 *
 * The material of a surface is edited where it is drawn: by the properties Haptic... of a
 * representation, and of the proxy in HapticProperties. It is the same in all representations of
 * one output of a source: a change in one is taken over by the others, and by those that are made
 * later, also where there was none meanwhile. For that it is an annotation of the source's proxy,
 * which state files keep; a material that was never changed is none.
 *
 * It also brings the questions of its representation on the client to all ranks of the server.
 *
 * GUI thread.
 *
 * @sa vtkHapticSurfaceRepresentation vtkHapticProperties
 */
#ifndef Haptics_vtkSMHapticSurfaceRepresentationProxy_h
#define Haptics_vtkSMHapticSurfaceRepresentationProxy_h

#include "vtkHapticsRepresentationsModule.h"
#include "vtkSMRepresentationProxy.h"
#include "vtkWeakPointer.h"

#include <string>
#include <vector>

class VTKHAPTICSREPRESENTATIONS_EXPORT vtkSMHapticSurfaceRepresentationProxy
  : public vtkSMRepresentationProxy
{
public:
  static vtkSMHapticSurfaceRepresentationProxy* New();
  vtkTypeMacro(vtkSMHapticSurfaceRepresentationProxy, vtkSMRepresentationProxy);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  void UpdateVTKObjects() override;

protected:
  vtkSMHapticSurfaceRepresentationProxy();
  ~vtkSMHapticSurfaceRepresentationProxy() override;

  void CreateVTKObjects() override;

private:
  vtkSMHapticSurfaceRepresentationProxy(const vtkSMHapticSurfaceRepresentationProxy&) = delete;
  void operator=(const vtkSMHapticSurfaceRepresentationProxy&) = delete;

  void FollowSource();
  void FollowParts();
  void Share();
  std::string GetMaterial();
  void TakeMaterial(const std::string& material);

  vtkWeakPointer<vtkSMProxy> Source;             // whose material was taken over
  std::string Key;                               // of the source's annotation
  std::vector<vtkWeakPointer<vtkSMProxy>> Parts; // of the material, that are observed
};

#endif
