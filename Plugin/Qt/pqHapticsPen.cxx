#include "pqHapticsPen.h"

#include "RecordSource.h"
#include "pqHapticsManager.h"
#include "vtkGodObjectActor.h"
#include "vtkHapticRecordSource.h"
#include "vtkHapticScene.h"
#include "vtkHapticView.h"
#include "vtkNew.h"
#include "vtkPVHapticPicture.h"
#include "vtkPVHapticRecords.h"
#include "vtkPVHapticScene.h"
#include "vtkPolyData.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMProxy.h"

pqHapticsPen::pqHapticsPen(pqHapticsManager* manager)
  : Superclass(manager)
  , Manager(manager)
{
  // What was drawn until the hand is released is kept.
  this->connect(manager, &pqHapticsManager::engagedChanged, this,
    [this](bool engaged) { this->draw(engaged && this->Drawing); });
}

void pqHapticsPen::draw(bool on)
{
  if (on != this->Drawing && this->Manager->clientScene())
  {
    on ? this->begin() : this->end();
    this->Drawing = on;
    emit this->Manager->updated();
  }
}

void pqHapticsPen::begin()
{
  vtkPVHapticScene* scene = this->Manager->clientScene();
  scene->Update(); // ticks until now are not drawn
  this->KeepsTrace = !scene->GetRecords()->GetRecordTrace();
  if (this->KeepsTrace)
  {
    this->Manager->setForNow("RecordTrace", 1);
  }
  this->First = scene->GetScene()->GetTraceRecorder()->GetNumberOfTicks();
  this->showTrail(true);
}

void pqHapticsPen::end()
{
  vtkPVHapticScene* scene = this->Manager->clientScene();
  scene->Update(); // ticks until now are drawn
  this->showTrail(vtkSMPropertyHelper(this->Manager->scene(), "ShowTrail").GetAsInt() != 0);
  vtkNew<vtkPolyData> curves;
  vtkHapticRecordSource::MakeCurves(scene->GetScene()->GetTrace(), this->First, curves);
  if (this->KeepsTrace)
  {
    this->Manager->setForNow("RecordTrace", 0);
  }
  if (curves->GetNumberOfLines() > 0)
  {
    haptics::MakeCurvesSource(curves);
  }
}

void pqHapticsPen::showTrail(bool show)
{
  this->Manager->clientScene()->GetPicture()->SetShowTrail(show);
  this->Manager->redraw();
}
