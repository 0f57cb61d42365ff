#include "pqHapticsRecorder.h"

#include "pqCoreUtilities.h"
#include "pqFileDialog.h"
#include "pqHapticsManager.h"
#include "pqUndoStack.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMProxy.h"

#include <QFileInfo>

pqHapticsRecorder::pqHapticsRecorder(pqHapticsManager* manager)
  : Superclass(manager)
  , Manager(manager)
{
  this->connect(manager, &pqHapticsManager::engagedChanged, this, &pqHapticsRecorder::followHand);
}

QString pqHapticsRecorder::file() const
{
  vtkSMProxy* scene = this->Manager->scene();
  return scene ? vtkSMPropertyHelper(scene, "RecordingFileName").GetAsString() : "";
}

QString pqHapticsRecorder::state() const
{
  const QString name = QFileInfo(this->isArmed() ? this->file() : this->Recorded).fileName();
  return this->Recording ? "recording to " + name
    : this->isArmed()    ? "records to " + name + " from the next Engage"
    : !name.isEmpty()    ? "recorded to " + name
                         : QString("off");
}

void pqHapticsRecorder::arm(bool on)
{
  if (!on || !this->Manager->makeScene())
  {
    this->setFile(QString());
    return;
  }
  // The hand is at the client, so its files are. This kind of dialog asks before it takes a file
  // that exists.
  auto* dialog = new pqFileDialog(nullptr, pqCoreUtilities::mainWidget(),
    "Record What the Hand Does", QString(), "Haptic recordings (*.hrec)", false);
  dialog->setObjectName("HapticRecorderDialog");
  dialog->setFileMode(pqFileDialog::AnyFile);
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  this->connect(dialog, &QDialog::accepted, this,
    [this, dialog] { this->setFile(dialog->getSelectedFiles().value(0)); });
  this->connect(dialog, &QDialog::rejected, this->Manager, &pqHapticsManager::updated);
  dialog->open();
}

void pqHapticsRecorder::setFile(const QString& file)
{
  vtkSMProxy* scene = this->Manager->scene();
  if (scene && file != this->file())
  {
    SCOPED_UNDO_EXCLUDE();
    vtkSMPropertyHelper(scene, "RecordingFileName").Set(file.toUtf8().data());
    scene->UpdateVTKObjects();
  }
  emit this->Manager->updated();
}

void pqHapticsRecorder::followHand(bool engaged)
{
  if (engaged)
  {
    this->Recording = this->isArmed();
  }
  else if (this->Recording)
  {
    this->Recording = false;
    this->Recorded = this->file();
    this->setFile(QString());
  }
}
