/**
 * @class   vtkHapticSurfaceRepresentation
 * @brief   Brings the triangles of a surface to the client to be touched, however it is drawn
 *
 * One of the representations that a source has in a view. Where it is touchable, each process makes
 * triangles of its piece of the surface (without ghost cells, lines and vertices) and gives them to
 * the view on a port of their own, HapticPort. The view brings all pieces to the client with each
 * render, wherever it draws; a process that is alone has them without one. GetTouchedActor() has
 * them there.
 *
 * Another representation of the source may be drawn meanwhile, Surface With Edges or Volume for
 * example: SetTouchable(). Where this one is chosen itself, as Haptic Surface, it draws what
 * Surface draws and is always touchable.
 *
 * Any data whose outside is a surface will do, as for Surface. The blocks of composite data that
 * are shown become one surface; point and cell arrays that all blocks have come along, to be
 * probed.
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

#include <map>
#include <string>
#include <vector>

class vtkActor;
class vtkDataObject;
class vtkGodObjectFilter;
class vtkHapticProperties;
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
  /**
   * Whether the source is shown, by whichever of its representations. Default on; ParaView's own
   * property Visibility sets it.
   */
  void SetShown(bool shown);
  /** Whether the view asks this representation for data: it is drawn, or touched beside. */
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

  ///@{
  /**
   * How it feels. Null, the default: the scene's stiffness and nothing else. The arrays are chosen
   * as by vtkAlgorithm::SetInputArrayToProcess(), with the indices of
   * vtkHapticProperties::PropertyType and vtkGodObjectFilter::SIDE_ARRAY; port and connection are
   * not looked at.
   */
  void SetHapticProperties(vtkHapticProperties* properties);
  vtkHapticProperties* GetHapticProperties();
  void SetHapticArray(int property, int port, int connection, int association, const char* name);
  ///@}
  /** Makes a surface of the scene feel so. */
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

  bool Touchable = false;
  bool Shown = true;
  std::vector<std::string> ShownBlocks;        // the selectors that LocalTriangles were made by
  vtkSmartPointer<vtkPolyData> LocalTriangles; // another object after each change
  vtkSmartPointer<vtkDataObject> Delivered;
  vtkMTimeType DeliveredTime = 0;
  bool WasDelivered = false;         // by a render
  vtkSmartPointer<vtkActor> Touched; // made when something is delivered
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
