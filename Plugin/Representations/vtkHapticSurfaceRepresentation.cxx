#include "vtkHapticSurfaceRepresentation.h"

#include "ServedSurface.h"
#include "vtkActor.h"
#include "vtkAppendPolyData.h"
#include "vtkCellArray.h"
#include "vtkCompositeDataIterator.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataAssembly.h"
#include "vtkDataAssemblyUtilities.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkGodObjectFilter.h"
#include "vtkHapticPatchInformation.h"
#include "vtkHapticProperties.h"
#include "vtkInformation.h"
#include "vtkMatrix4x4.h"
#include "vtkMultiProcessController.h"
#include "vtkObjectFactory.h"
#include "vtkPVHapticPatchSource.h"
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
#include <utility>

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

/// Whether a script drives this process and others with it, with no client: pvbatch under MPI.
bool IsBatchOfSeveral()
{
  vtkProcessModule* processes = vtkProcessModule::GetProcessModule();
  return processes && processes->GetNumberOfLocalPartitions() > 1 &&
    vtkProcessModule::GetProcessType() == vtkProcessModule::PROCESS_BATCH;
}

/// Whether this process is alone. A client of a server has no pieces.
bool HasAllPieces()
{
  vtkProcessModule* processes = vtkProcessModule::GetProcessModule();
  return processes && processes->GetNumberOfLocalPartitions() == 1;
}

/// The pieces of all processes where the hand is: in the first, or in each where each runs the
/// script. ParaView's delivery to clients brings nothing together where there is none.
vtkSmartPointer<vtkPolyData> Collect(vtkPolyData* piece)
{
  vtkProcessModule* processes = vtkProcessModule::GetProcessModule();
  vtkMultiProcessController* controller = processes->GetGlobalController();
  std::vector<vtkSmartPointer<vtkDataObject>> pieces;
  const bool hasWorked = processes->GetSymmetricMPIMode() ? controller->AllGather(piece, pieces)
                                                          : controller->Gather(piece, pieces, 0);
  vtkNew<vtkAppendPolyData> append;
  for (vtkDataObject* received : pieces)
  {
    auto* triangles = vtkPolyData::SafeDownCast(received);
    if (hasWorked && triangles && triangles->GetNumberOfPolys() > 0)
    {
      append->AddInputData(triangles);
    }
  }
  if (append->GetNumberOfInputConnections(0) == 0)
  {
    return vtkSmartPointer<vtkPolyData>::New();
  }
  append->Update();
  return append->GetOutput();
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
  , Piece(this->LocalTriangles)
{
  this->Patches = vtkSmartPointer<vtkPVHapticPatchSource>::New();
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

void vtkHapticSurfaceRepresentation::SetPatchThreshold(vtkIdType triangles)
{
  triangles = std::max(triangles, vtkIdType{ 0 });
  if (triangles != this->PatchThreshold)
  {
    this->PatchThreshold = triangles;
    this->MarkModified();
  }
}

void vtkHapticSurfaceRepresentation::SetPatchRadius(double radius)
{
  this->PatchRadius = radius;
  this->Patches->SetPatchRadius(radius);
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
  this->Serve();
  if (IsBatchOfSeveral()) // a touched surface is updated in all at once
  {
    this->Receive(this->Served ? this->Piece : Collect(this->LocalTriangles));
  }
  return 1;
}

/// Decides whether the triangles are brought to the client, and if not, gets ready to be asked.
/// All processes do at once.
void vtkHapticSurfaceRepresentation::Serve()
{
  ++this->Version;
  const haptics::ServedShape touched =
    this->Served ? this->Served->Touched() : haptics::ServedShape();
  this->Served.reset();
  this->Piece = this->LocalTriangles;
  vtkProcessModule* const processes = vtkProcessModule::GetProcessModule();
  if (!processes || processes->GetSymmetricMPIMode())
  {
    return; // each process has a client of its own, and none can ask the others
  }
  vtkMultiProcessController* const controller = processes->GetGlobalController();
  const vtkIdType all =
    haptics::ServedSurface::Count(this->LocalTriangles->GetNumberOfPolys(), controller);
  if (all > this->PatchThreshold)
  {
    this->Served = std::make_unique<haptics::ServedSurface>(
      this->LocalTriangles, this->Version, touched, controller);
    this->Piece = vtkSmartPointer<vtkPolyData>::New();
  }
}

void vtkHapticSurfaceRepresentation::Answer(vtkHapticPatchInformation* question)
{
  const bool isFirst =
    vtkProcessModule::GetProcessModule()->GetGlobalController()->GetLocalProcessId() == 0;
  if (isFirst)
  {
    question->SetHead(
      this->Served != nullptr, this->Version, this->Served ? this->Served->Error() : "");
  }
  if (!this->Served)
  {
    return;
  }
  using Question = vtkHapticPatchInformation::Question;
  if (question->GetQuestion() != Question::Whole)
  {
    const haptics::PatchRegion region = question->GetRegion();
    question->SetPart(question->GetQuestion() == Question::Nearest
        ? this->Served->Nearest(region.From)
        : this->Served->Crop(region));
    if (question->GetQuestion() == Question::TouchedRegion)
    {
      this->Served->SetTouched();
    }
    return;
  }
  const vtkSmartPointer<vtkPolyData> sample = this->Served->Sample();
  if (const haptics::PatchRecord* const whole = this->Served->Whole())
  {
    whole->WriteTo(sample->GetFieldData());
    vtkNew<vtkDoubleArray> box;
    box->SetName(vtkPVHapticPatchSource::BoxName);
    box->SetNumberOfComponents(3);
    box->InsertNextTuple(this->Served->Box().Low.data());
    box->InsertNextTuple(this->Served->Box().High.data());
    sample->GetFieldData()->AddArray(box);
  }
  question->SetPart(sample);
}

void vtkHapticSurfaceRepresentation::SetGather(
  std::function<void(vtkHapticPatchInformation*)> gather)
{
  this->Patches->SetGather(std::move(gather));
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
    const unsigned long kilobytes = std::max(this->Piece->GetActualMemorySize(), 1ul);
    vtkPVView::SetPiece(inInfo, this, this->Piece, kilobytes, HapticPort);
    vtkPVRenderView::SetDeliverToClientAndRenderingProcesses(inInfo, this, true, true, HapticPort);
    if (!this->WasDelivered && HasAllPieces() && this->LocalTriangles->GetNumberOfPolys() > 0)
    {
      this->Receive(this->Piece); // the same that a render brings, which may never come
    }
  }
  else if (request == vtkPVView::REQUEST_RENDER() && !IsBatchOfSeveral())
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
  if (!this->TouchActor)
  {
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputConnection(this->Producer->GetOutputPort());
    this->TouchActor = vtkSmartPointer<vtkActor>::New();
    this->TouchActor->SetMapper(mapper);
  }
  this->Producer->SetOutput(triangles);
  this->IsDeliveryNew = true;
}

/// What the actor shows: all triangles, or, where none were brought, what the processes may give of
/// them. Not within a render, when the server cannot be asked.
void vtkHapticSurfaceRepresentation::ConnectTouched()
{
  const bool mayBeInPatches = vtkPolyData::SafeDownCast(this->Delivered)->GetNumberOfCells() == 0;
  if (mayBeInPatches)
  {
    this->Patches->SetOutdated();
  }
  vtkAlgorithm* const source = mayBeInPatches && this->Patches->IsInPatches()
    ? static_cast<vtkAlgorithm*>(this->Patches)
    : static_cast<vtkAlgorithm*>(this->Producer);
  this->TouchActor->GetMapper()->SetInputConnection(source->GetOutputPort());
}

vtkPVHapticPatchSource* vtkHapticSurfaceRepresentation::GetPatches()
{
  const bool isConnected =
    this->TouchActor && this->TouchActor->GetMapper()->GetInputAlgorithm() == this->Patches;
  return isConnected ? this->Patches : nullptr;
}

vtkActor* vtkHapticSurfaceRepresentation::GetTouchedActor()
{
  if (std::exchange(this->IsDeliveryNew, false))
  {
    this->ConnectTouched();
  }
  if (this->TouchActor)
  {
    vtkProp3D* drawn = this->GetActor();
    vtkMatrix4x4* matrix = this->TouchActor->GetUserMatrix();
    const bool hasMoved = !matrix ||
      !std::equal(matrix->GetData(), matrix->GetData() + 16, drawn->GetMatrix()->GetData());
    if (hasMoved)
    {
      vtkNew<vtkMatrix4x4> moved;
      moved->DeepCopy(drawn->GetMatrix());
      this->TouchActor->SetUserMatrix(moved);
    }
    this->TouchActor->SetVisibility(this->GetVisibility());
    this->TouchActor->SetPickable(drawn->GetPickable());
  }
  return this->TouchActor;
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
  os << indent << "PatchThreshold: " << this->PatchThreshold << "\n";
  os << indent << "PatchRadius: " << this->PatchRadius << "\n";
  os << indent << "Triangles to touch: " << (delivered ? delivered->GetNumberOfPolys() : 0) << "\n";
}
