#include "vtkHapticSurfaceRepresentation.h"

#include "vtkActor.h"
#include "vtkAppendPolyData.h"
#include "vtkCellArray.h"
#include "vtkCompositeDataIterator.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataAssembly.h"
#include "vtkDataAssemblyUtilities.h"
#include "vtkGodObjectFilter.h"
#include "vtkHapticProperties.h"
#include "vtkInformation.h"
#include "vtkMatrix4x4.h"
#include "vtkObjectFactory.h"
#include "vtkPVLODActor.h"
#include "vtkPVRenderView.h"
#include "vtkPartitionedDataSetCollection.h"
#include "vtkPolyData.h"
#include "vtkPolyDataMapper.h"
#include "vtkProcessModule.h"
#include "vtkTriangleFilter.h"
#include "vtkTrivialProducer.h"

#include <algorithm>
#include <set>

vtkStandardNewMacro(vtkHapticSurfaceRepresentation);

namespace
{
/// The flat indices of the leaves that selectors name; none where they name all, or nothing known.
std::set<unsigned int> Selected(
  vtkCompositeDataSet* data, const std::vector<std::string>& selectors)
{
  vtkNew<vtkDataAssembly> hierarchy;
  if (selectors.empty() || selectors == std::vector<std::string>{ "/" } ||
    !vtkDataAssemblyUtilities::GenerateHierarchy(data, hierarchy))
  {
    return {};
  }
  const std::vector<unsigned int> ids = vtkDataAssemblyUtilities::GetSelectedCompositeIds(
    selectors, hierarchy, vtkPartitionedDataSetCollection::SafeDownCast(data), true);
  return { ids.begin(), ids.end() };
}

/// Every polydata in a data object whose block is shown, in one.
vtkSmartPointer<vtkPolyData> Gather(vtkDataObject* data, const std::vector<std::string>& selectors)
{
  auto* composite = vtkCompositeDataSet::SafeDownCast(data);
  if (!composite)
  {
    return vtkPolyData::SafeDownCast(data);
  }
  const std::set<unsigned int> shown = Selected(composite, selectors);
  vtkNew<vtkAppendPolyData> append;
  auto blocks = vtkSmartPointer<vtkCompositeDataIterator>::Take(composite->NewIterator());
  for (blocks->InitTraversal(); !blocks->IsDoneWithTraversal(); blocks->GoToNextItem())
  {
    auto* block = vtkPolyData::SafeDownCast(blocks->GetCurrentDataObject());
    const bool isShown = shown.empty() || shown.count(blocks->GetCurrentFlatIndex()) > 0;
    if (block && block->GetNumberOfPoints() > 0 && isShown)
    {
      append->AddInputData(block);
    }
  }
  if (append->GetNumberOfInputConnections(0) == 0)
  {
    return vtkSmartPointer<vtkPolyData>::New(); // this process holds no data
  }
  append->Update();
  return append->GetOutput();
}

/// Whether this process is alone. A client of a server has no pieces.
bool HasAllPieces()
{
  vtkProcessModule* processes = vtkProcessModule::GetProcessModule();
  return processes && processes->GetNumberOfLocalPartitions() == 1;
}

/// The triangles of the cells that are this process' own.
vtkSmartPointer<vtkPolyData> Triangulate(vtkPolyData* surface)
{
  auto own = vtkSmartPointer<vtkPolyData>::New();
  own->ShallowCopy(surface);
  own->RemoveGhostCells();
  const bool areTriangles =
    own->GetPolys()->IsHomogeneous() == 3 && own->GetNumberOfCells() == own->GetNumberOfPolys();
  if (areTriangles)
  {
    return own;
  }
  vtkNew<vtkTriangleFilter> triangulate;
  triangulate->PassVertsOff();
  triangulate->PassLinesOff();
  triangulate->SetInputData(own);
  triangulate->Update();
  return triangulate->GetOutput();
}
}

vtkHapticSurfaceRepresentation::vtkHapticSurfaceRepresentation()
  : LocalTriangles(vtkSmartPointer<vtkPolyData>::New())
{
}

vtkHapticSurfaceRepresentation::~vtkHapticSurfaceRepresentation() = default;

void vtkHapticSurfaceRepresentation::SetTouchable(bool touchable)
{
  if (touchable != this->Touchable)
  {
    this->Touchable = touchable;
    this->MarkModified();
  }
}

void vtkHapticSurfaceRepresentation::SetShown(bool shown)
{
  this->Shown = shown;
}

bool vtkHapticSurfaceRepresentation::GetVisibility()
{
  return this->Superclass::GetVisibility() || (this->Touchable && this->Shown);
}

int vtkHapticSurfaceRepresentation::RequestData(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  if (!this->Superclass::RequestData(request, inputVector, outputVector))
  {
    return 0;
  }
  this->ShownBlocks.assign(this->BlockSelectors.begin(), this->BlockSelectors.end());
  vtkSmartPointer<vtkPolyData> surface = Gather(this->GetRenderedDataObject(0), this->ShownBlocks);
  this->LocalTriangles = surface ? Triangulate(surface) : vtkSmartPointer<vtkPolyData>::New();
  return 1;
}

int vtkHapticSurfaceRepresentation::ProcessViewRequest(
  vtkInformationRequestKey* request, vtkInformation* inInfo, vtkInformation* outInfo)
{
  const bool blocksChanged = !std::equal(this->ShownBlocks.begin(), this->ShownBlocks.end(),
    this->BlockSelectors.begin(), this->BlockSelectors.end());
  if (request == vtkPVView::REQUEST_UPDATE() && blocksChanged)
  {
    this->MarkModified(); // for drawing no new data are needed, for touching they are
  }
  // Where another representation is drawn, this one gives the view nothing to draw.
  const bool isDrawn = this->Superclass::GetVisibility();
  const int isDone = isDrawn
    ? this->Superclass::ProcessViewRequest(request, inInfo, outInfo)
    // NOLINTNEXTLINE(bugprone-parent-virtual-call): the superclass would give something to draw
    : this->vtkPVDataRepresentation::ProcessViewRequest(request, inInfo, outInfo);
  if (!isDone)
  {
    return 0; // hidden
  }
  if (request == vtkPVView::REQUEST_UPDATE())
  {
    // The size of what is drawn decides where it is drawn; this is not drawn, and counts for 1 KB.
    vtkPVView::SetPiece(inInfo, this, this->LocalTriangles, 1, HapticPort);
    vtkPVRenderView::SetDeliverToClientAndRenderingProcesses(inInfo, this, true, true, HapticPort);
    if (!this->WasDelivered && HasAllPieces() && this->LocalTriangles->GetNumberOfPolys() > 0)
    {
      this->Receive(this->LocalTriangles); // the same that a render brings, which may never come
    }
  }
  else if (request == vtkPVView::REQUEST_RENDER())
  {
    vtkDataObject* delivered = vtkPVView::GetDeliveredPiece(inInfo, this, HapticPort);
    this->WasDelivered = this->WasDelivered || delivered;
    this->Receive(delivered);
  }
  return 1;
}

void vtkHapticSurfaceRepresentation::Receive(vtkDataObject* delivered)
{
  auto* triangles = vtkPolyData::SafeDownCast(delivered);
  if (!triangles || (triangles == this->Delivered && triangles->GetMTime() == this->DeliveredTime))
  {
    return;
  }
  this->Delivered = triangles;
  this->DeliveredTime = triangles->GetMTime();
  if (!this->Touched)
  {
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputConnection(this->Producer->GetOutputPort());
    this->Touched = vtkSmartPointer<vtkActor>::New();
    this->Touched->SetMapper(mapper);
  }
  this->Producer->SetOutput(triangles);
}

vtkActor* vtkHapticSurfaceRepresentation::GetTouchedActor()
{
  if (this->Touched)
  {
    vtkProp3D* drawn = this->GetActor();
    vtkMatrix4x4* matrix = this->Touched->GetUserMatrix();
    const bool hasMoved = !matrix ||
      !std::equal(matrix->GetData(), matrix->GetData() + 16, drawn->GetMatrix()->GetData());
    if (hasMoved)
    {
      vtkNew<vtkMatrix4x4> moved;
      moved->DeepCopy(drawn->GetMatrix());
      this->Touched->SetUserMatrix(moved);
    }
    this->Touched->SetVisibility(this->GetVisibility());
    this->Touched->SetPickable(drawn->GetPickable());
  }
  return this->Touched;
}

void vtkHapticSurfaceRepresentation::SetHapticProperties(vtkHapticProperties* properties)
{
  if (this->HapticProperties != properties)
  {
    this->HapticProperties = properties;
  }
}

vtkHapticProperties* vtkHapticSurfaceRepresentation::GetHapticProperties()
{
  return this->HapticProperties;
}

void vtkHapticSurfaceRepresentation::SetHapticArray(
  int property, int, int, int association, const char* name)
{
  ArrayChoice& choice = this->HapticArrays[property];
  choice.Association = association;
  choice.Name = name ? name : "";
}

void vtkHapticSurfaceRepresentation::Configure(vtkGodObjectFilter* filter)
{
  if (this->HapticProperties)
  {
    filter->SetProperties(this->HapticProperties);
  }
  for (const auto& [property, choice] : this->HapticArrays)
  {
    // Does nothing where the filter has that choice.
    filter->SetInputArrayToProcess(property, 0, 0, choice.Association, choice.Name.c_str());
  }
}

void vtkHapticSurfaceRepresentation::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Triangles of this process: " << this->LocalTriangles->GetNumberOfPolys() << "\n";
  auto* delivered = vtkPolyData::SafeDownCast(this->Delivered);
  os << indent << "Triangles to touch: " << (delivered ? delivered->GetNumberOfPolys() : 0) << "\n";
}
