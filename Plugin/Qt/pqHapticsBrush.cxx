#include "pqHapticsBrush.h"

#include "pqApplicationCore.h"
#include "pqHapticsActions.h"
#include "pqHapticsManager.h"
#include "pqOutputPort.h"
#include "pqSelectionManager.h"
#include "vtkIdTypeArray.h"
#include "vtkNew.h"
#include "vtkPVDataInformation.h"
#include "vtkPVHapticReadings.h"
#include "vtkPVHapticScene.h"
#include "vtkSMProxy.h"
#include "vtkSMSelectionHelper.h"
#include "vtkSMSourceProxy.h"
#include "vtkSelection.h"
#include "vtkSelectionNode.h"
#include "vtkSmartPointer.h"

#include <QAction>

pqHapticsBrush::pqHapticsBrush(pqHapticsManager* manager)
  : Superclass(manager)
  , Manager(manager)
{
  this->connect(manager, &pqHapticsManager::updated, this, &pqHapticsBrush::paint);
}

void pqHapticsBrush::paint()
{
  QAction* const paint = pqHapticsActions::instance()->paint();
  QAction* const follow = pqHapticsActions::instance()->selectTouched();
  if (!paint->isChecked() && !follow->isChecked())
  {
    this->Port = nullptr; // the next stroke selects anew
    this->Cells.clear();
    return;
  }
  vtkPVHapticScene* scene = this->Manager->clientScene();
  pqOutputPort* port =
    scene && scene->GetReadings()->GetTouching() ? this->Manager->touchedPort() : nullptr;
  const vtkIdType cell = port ? scene->GetReadings()->GetTouchedCell() : -1;
  if (cell < 0)
  {
    return;
  }
  if (port->getDataInformation()->IsCompositeDataSet())
  {
    paint->setChecked(false);
    follow->setChecked(false);
    this->Manager->complain("Paint Selection",
      "Cells of data with several blocks cannot be selected by touch. Apply Merge Blocks, and "
      "touch that.");
    return;
  }
  if (port != this->Port || (follow->isChecked() && this->Cells.count(cell) == 0))
  {
    this->Port = port;
    this->Cells.clear();
  }
  if (this->Cells.insert(cell).second)
  {
    this->select();
  }
}

void pqHapticsBrush::select()
{
  vtkNew<vtkIdTypeArray> ids;
  for (const vtkIdType cell : this->Cells)
  {
    ids->InsertNextValue(cell);
  }
  vtkNew<vtkSelectionNode> node;
  node->SetContentType(vtkSelectionNode::INDICES);
  node->SetFieldType(vtkSelectionNode::CELL);
  node->SetSelectionList(ids);
  vtkNew<vtkSelection> selection;
  selection->AddNode(node);
  vtkSmartPointer<vtkSMProxy> cells;
  cells.TakeReference(vtkSMSelectionHelper::NewSelectionSourceFromSelection(
    this->Port->getSourceProxy()->GetSession(), selection, true));
  vtkSmartPointer<vtkSMProxy> appended;
  appended.TakeReference(vtkSMSelectionHelper::NewAppendSelectionsFromSelectionSource(
    vtkSMSourceProxy::SafeDownCast(cells)));
  this->Port->setSelectionInput(vtkSMSourceProxy::SafeDownCast(appended), 0);
  // Found as a child: the application's own class is not there in pvpython.
  if (auto* manager = pqApplicationCore::instance()->findChild<pqSelectionManager*>())
  {
    manager->select(this->Port);
  }
  this->Port->renderAllViews(false);
}
