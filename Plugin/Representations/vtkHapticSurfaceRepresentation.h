/**
 * @class   vtkHapticSurfaceRepresentation
 * @brief   Brings the triangles of a surface to the client to be touched, however it is drawn
 *
 * One of the representations that a source has in a view. Where it is touchable, each process makes
 * triangles of its piece of the surface (without ghost cells, lines and vertices) and gives them to
 * the view on a port of their own, HapticPort. The view brings all pieces to the client with each
 * render, wherever it draws; a process that is alone has them without one, and so has the first of
 * several that a script drives without a client (pvbatch under MPI). GetTouchedActor() has them
 * there.
 *
 * Another representation of the source may be drawn meanwhile, Surface With Edges or Volume for
 * example: SetTouchable(). Where this one is chosen itself, as Haptic Surface, it draws what
 * Surface draws and is always touchable.
 *
 * Any data whose outside is a surface will do, as for Surface. The blocks of composite data that
 * are shown become one surface; point and cell arrays that all blocks have come along, to be
 * probed.
 *
 * A surface with more triangles than PatchThreshold is not brought: the processes keep it, and give
 * the client what is near its hand, as it goes on (vtkPVHapticPatchSource). Forces are the
 * same.
 *
 * While the source is hidden it cannot be touched.
 *
 * GUI thread.
 *
 * @sa vtkPVHapticScene
 */
#ifndef Haptics_vtkHapticSurfaceRepresentation_h
#define Haptics_vtkHapticSurfaceRepresentation_h

#include "vtkGeometryRepresentationWithFaces.h"
#include "vtkHapticsRepresentationsModule.h"
#include "vtkNew.h"
#include "vtkSmartPointer.h"

#ifndef __VTK_WRAP__
#include <functional>
#endif
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace haptics
{
class ServedSurface;
}

class vtkActor;
class vtkDataObject;
class vtkGodObjectFilter;
class vtkHapticPatchInformation;
class vtkHapticProperties;
class vtkPVHapticPatchSource;
class vtkPolyData;
class vtkTrivialProducer;

class VTKHAPTICSREPRESENTATIONS_EXPORT vtkHapticSurfaceRepresentation
  : public vtkGeometryRepresentationWithFaces
{
public:
  static vtkHapticSurfaceRepresentation* New();
  vtkTypeMacro(vtkHapticSurfaceRepresentation, vtkGeometryRepresentationWithFaces);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /** Whether the surface can be touched while another representation is drawn. Default off. */
  void SetTouchable(bool touchable);
  vtkGetMacro(Touchable, bool);
  ///@}
  ///@{
  /**
   * A surface with more triangles than this, of all processes together, comes in patches. Default
   * two million, which take a second to be built and 0.2 GB on the client; 0: all do. At least 0,
   * clamped.
   */
  void SetPatchThreshold(vtkIdType triangles);
  vtkGetMacro(PatchThreshold, vtkIdType);
  ///@}
  ///@{
  /** As vtkHapticPatchAlgorithm::SetPatchRadius(): of the patches [world unit]. Default 0: chosen.
   */
  void SetPatchRadius(double radius);
  vtkGetMacro(PatchRadius, double);
  ///@}

  /**
   * Whether the source is shown, by whichever of its representations. Default on; ParaView's own
   * property Visibility sets it.
   */
  void SetShown(bool shown);
  /** Whether the view asks this representation for data: it is drawn, or touched while another one
   * is. */
  bool GetVisibility() override;

  /** The port of the view that the triangles go through. */
  static constexpr int HapticPort = 1;

  int ProcessViewRequest(
    vtkInformationRequestKey* request, vtkInformation* inInfo, vtkInformation* outInfo) override;

  /**
   * On the client: what is touched, for vtkHapticScene::AddSurface(). An actor in no renderer with
   * the triangles of all processes and the matrix, visibility and pickability that the
   * representation has now. Null before the first render (of a single process: before the
   * view's first update), and where nothing was delivered.
   */
  vtkActor* GetTouchedActor();

  /** On the client: what gives the patches; null where the surface comes whole. */
  vtkPVHapticPatchSource* GetPatches();
#ifndef __VTK_WRAP__
  ///@{
  /** C++ only. On the client: how all processes are asked. In each of them: the answer. */
  void SetGather(std::function<void(vtkHapticPatchInformation*)> gather);
  void Answer(vtkHapticPatchInformation* question);
  ///@}
#endif

  ///@{
  /**
   * Its material. Null, the default: the scene's stiffness and nothing else. The arrays are chosen
   * as by vtkAlgorithm::SetInputArrayToProcess(), with the indices of
   * vtkHapticProperties::PropertyType and vtkGodObjectFilter::SIDE_ARRAY; port and connection are
   * not looked at.
   */
  void SetHapticProperties(vtkHapticProperties* properties);
  vtkHapticProperties* GetHapticProperties();
  void SetHapticArray(int property, int port, int connection, int association, const char* name);
  ///@}
  /** Gives a surface of the scene this material. */
  void Configure(vtkGodObjectFilter* filter);

protected:
  vtkHapticSurfaceRepresentation();
  ~vtkHapticSurfaceRepresentation() override;

  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

private:
  vtkHapticSurfaceRepresentation(const vtkHapticSurfaceRepresentation&) = delete;
  void operator=(const vtkHapticSurfaceRepresentation&) = delete;

  void Receive(vtkDataObject* delivered);
  void Serve();
  void ConnectTouched();

  bool Touchable = false;
  bool Shown = true;
  vtkIdType PatchThreshold = 20000000;
  double PatchRadius = 0.0;
  std::unique_ptr<haptics::ServedSurface> Served;  // where it comes in patches
  vtkTypeUInt64 Version = 0;                       // of the data of this process
  vtkSmartPointer<vtkPVHapticPatchSource> Patches; // on the client
  bool IsDeliveryNew = false;                      // and whether it is of patches is not known
  std::vector<std::string> ShownBlocks;            // the selectors that LocalTriangles were made by
  vtkSmartPointer<vtkPolyData> LocalTriangles;     // another object after each change
  vtkSmartPointer<vtkPolyData> Piece;              // what of them is brought
  vtkSmartPointer<vtkDataObject> Delivered;
  vtkMTimeType DeliveredTime = 0;
  bool WasDelivered = false;            // by a render
  vtkSmartPointer<vtkActor> TouchActor; // made when something is delivered
  vtkNew<vtkTrivialProducer> Producer;

  struct ArrayChoice
  {
    int Association = 0;
    std::string Name;
  };
  vtkSmartPointer<vtkHapticProperties> HapticProperties;
  std::map<int, ArrayChoice> HapticArrays; // by property
};

#endif
