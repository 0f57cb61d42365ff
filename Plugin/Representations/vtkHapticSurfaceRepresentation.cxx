#include "vtkHapticSurfaceRepresentation.h"

#include "vtkActor.h"
#include "vtkAppendPolyData.h"
#include "vtkCompositeDataIterator.h"
#include "vtkCompositeDataSet.h"
#include "vtkInformation.h"
#include "vtkMatrix4x4.h"
#include "vtkObjectFactory.h"
#include "vtkPVLODActor.h"
#include "vtkPVRenderView.h"
#include "vtkPolyData.h"
#include "vtkPolyDataMapper.h"
#include "vtkTriangleFilter.h"
#include "vtkTrivialProducer.h"

vtkStandardNewMacro(vtkHapticSurfaceRepresentation);

namespace
{
/// Every polydata in a data object, in one.
vtkSmartPointer<vtkPolyData> Gather(vtkDataObject* data)
{
  auto* composite = vtkCompositeDataSet::SafeDownCast(data);
  if (!composite)
  {
    return vtkPolyData::SafeDownCast(data);
  }
  vtkNew<vtkAppendPolyData> append;
  auto blocks = vtkSmartPointer<vtkCompositeDataIterator>::Take(composite->NewIterator());
  for (blocks->InitTraversal(); !blocks->IsDoneWithTraversal(); blocks->GoToNextItem())
  {
    auto* block = vtkPolyData::SafeDownCast(blocks->GetCurrentDataObject());
    if (block && block->GetNumberOfPoints() > 0)
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

/// The triangles of the cells that are this process' own.
vtkSmartPointer<vtkPolyData> Triangulate(vtkPolyData* surface)
{
  vtkNew<vtkPolyData> own;
  own->ShallowCopy(surface);
  own->RemoveGhostCells();
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

int vtkHapticSurfaceRepresentation::RequestData(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  if (!this->Superclass::RequestData(request, inputVector, outputVector))
  {
    return 0;
  }
  vtkSmartPointer<vtkPolyData> surface = Gather(this->GetRenderedDataObject(0));
  this->LocalTriangles = surface ? Triangulate(surface) : vtkSmartPointer<vtkPolyData>::New();
  return 1;
}

int vtkHapticSurfaceRepresentation::ProcessViewRequest(
  vtkInformationRequestKey* request, vtkInformation* inInfo, vtkInformation* outInfo)
{
  if (!this->Superclass::ProcessViewRequest(request, inInfo, outInfo))
  {
    this->Receive(nullptr); // hidden
    return 0;
  }
  if (request == vtkPVView::REQUEST_UPDATE())
  {
    // The size of what is drawn decides where it is drawn; this is not drawn, and counts for 1 KB.
    vtkPVView::SetPiece(inInfo, this, this->LocalTriangles, 1, HapticPort);
    vtkPVRenderView::SetDeliverToClientAndRenderingProcesses(inInfo, this, true, true, HapticPort);
  }
  else if (request == vtkPVView::REQUEST_RENDER())
  {
    this->Receive(vtkPVView::GetDeliveredPiece(inInfo, this, HapticPort));
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

void vtkHapticSurfaceRepresentation::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Triangles of this process: " << this->LocalTriangles->GetNumberOfPolys() << "\n";
  auto* delivered = vtkPolyData::SafeDownCast(this->Delivered);
  os << indent << "Triangles to touch: " << (delivered ? delivered->GetNumberOfPolys() : 0) << "\n";
}
