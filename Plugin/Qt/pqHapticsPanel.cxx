#include "pqHapticsPanel.h"
#include "ui_pqHapticsPanel.h"

#include "RecordSource.h"
#include "pqCoreUtilities.h"
#include "pqFileDialog.h"
#include "pqHapticsManager.h"
#include "pqHapticsRecorder.h"
#include "vtkCommand.h"
#include "vtkHapticDevice.h"
#include "vtkHapticLandmarks.h"
#include "vtkHapticReadings.h"
#include "vtkHapticScene.h"
#include "vtkHapticServo.h"
#include "vtkNew.h"
#include "vtkPVHapticReadings.h"
#include "vtkPVHapticRecords.h"
#include "vtkPVHapticScene.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMProxy.h"
#include "vtkStringArray.h"

#include <QApplication>
#include <QFileInfo>
#include <QHeaderView>
#include <QLocale>
#include <QScrollArea>
#include <QScrollBar>
#include <QSignalBlocker>

#include <algorithm>
#include <cmath>

namespace
{
constexpr int TextInterval = 100;        // [ms]; nobody reads faster
constexpr double WorkspaceStep = 1.25;   // of Finer and Coarser
constexpr const char* ChooseFile = "";   // the device chooser's entry that asks for a file
constexpr const char* FindDevices = ":"; // that which looks what is plugged in
constexpr int LastEntries = 2;           // these two
constexpr const char* PlayedFilter = "Haptic recordings (*.hrec);;Paths (*.vtp);;All files (*)";

QString number(double value, int digits)
{
  return QLocale::c().toString(value, 'f', digits);
}

/// A label of always the same height: what lies below it stays under the cursor.
void fixLines(QLabel* label, int lines)
{
  label->setFixedHeight(lines * label->fontMetrics().lineSpacing() + 2);
  label->setAlignment(Qt::AlignLeft | Qt::AlignTop);
}

/// Shows a value in a box, where that has another one: a text that is typed there stays.
void showValue(QDoubleSpinBox* box, double value)
{
  const double rounding = 0.5 * std::pow(10.0, -box->decimals());
  if (std::abs(box->value() - value) > rounding)
  {
    const QSignalBlocker blocker(box);
    box->setValue(value);
  }
}

/// The components of an array with as many digits as fit next to each other.
QString shortened(const QString& value)
{
  QStringList parts = value.split(", ");
  for (QString& part : parts)
  {
    bool isNumber = false;
    const double component = QLocale::c().toDouble(part, &isNumber);
    part = isNumber && parts.size() > 1 ? QString::number(component, 'g', 4) : part;
  }
  return parts.join(", ");
}
}

pqHapticsPanel::pqHapticsPanel(QWidget* parent, Qt::WindowFlags flags)
  : Superclass("Haptics", parent, flags)
  , Form(new Ui::pqHapticsPanel)
  , Manager(pqHapticsManager::instance())
{
  auto* content = new QWidget;
  this->Form->setupUi(content);
  auto* scrolled = new QScrollArea(this);
  scrolled->setWidgetResizable(true);
  scrolled->setFrameShape(QFrame::NoFrame);
  scrolled->setWidget(content);
  scrolled->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  scrolled->setMinimumWidth(
    content->minimumSizeHint().width() + scrolled->verticalScrollBar()->sizeHint().width());
  this->setWidget(scrolled);

  vtkNew<vtkStringArray> names;
  vtkNew<vtkStringArray> titles;
  vtkHapticDevice::GetKnownNames(names, titles);
  for (vtkIdType i = 0; i < names->GetNumberOfValues(); ++i)
  {
    this->Form->device->addItem(
      QString::fromStdString(titles->GetValue(i)), QString::fromStdString(names->GetValue(i)));
  }
  this->Form->device->addItem("Find devices...", FindDevices);
  this->Form->device->addItem("Recording...", ChooseFile);
  QTableWidget* values = this->Form->values;
  values->horizontalHeader()->setSectionResizeMode(0, QHeaderView::ResizeToContents);
  values->verticalHeader()->setDefaultSectionSize(values->fontMetrics().height() + 4);

  fixLines(this->Form->state, 2);
  fixLines(this->Form->safeStiffness, 2);
  fixLines(this->Form->servo, 2);
  fixLines(this->Form->contact, 2);
  QSizePolicy keepsPlace = this->Form->building->sizePolicy();
  keepsPlace.setRetainSizeWhenHidden(true);
  this->Form->building->setSizePolicy(keepsPlace);

  this->connectSettings();
  this->connectCommands();
  this->connect(this->Manager, &pqHapticsManager::sceneChanged, this, &pqHapticsPanel::followScene);
  this->connect(
    this->Manager, &pqHapticsManager::engagedChanged, this, &pqHapticsPanel::showSettings);
  this->connect(this->Manager, &pqHapticsManager::updated, this, &pqHapticsPanel::showReadings);
  this->followScene();
}

pqHapticsPanel::~pqHapticsPanel() = default;

void pqHapticsPanel::connectSettings()
{
  Ui::pqHapticsPanel& form = *this->Form;
  // activated() and clicked() report the user's hand only, not of what this panel shows.
  this->connect(
    form.device, QOverload<int>::of(&QComboBox::activated), this, &pqHapticsPanel::chooseDevice);
  this->connect(form.stiffness, QOverload<double>::of(&QDoubleSpinBox::valueChanged), this,
    [this](double value) { this->Manager->set("Haptic Stiffness", "Stiffness", value); });
  this->connect(form.maximumForce, QOverload<double>::of(&QDoubleSpinBox::valueChanged), this,
    [this](double value) { this->Manager->set("Largest Haptic Force", "MaximumForce", value); });
  this->connect(form.side, QOverload<int>::of(&QComboBox::activated), this,
    [this](int side) { this->Manager->set("Haptic Side", "Side", side); });
  this->connect(form.landmarkDistance, QOverload<int>::of(&QComboBox::activated), this,
    [this](int distance)
    {
      this->Manager->set("Landmark Distance", "LandmarkDistance", distance);
      this->Manager->redraw();
    });
  const auto show = [this](QAbstractButton* box, const char* property)
  {
    this->connect(box, &QAbstractButton::clicked, this,
      [this, property](bool on)
      {
        this->Manager->set("Picture of the Hand", property, on);
        this->Manager->redraw();
      });
  };
  show(form.showForce, "ShowForce");
  show(form.showReadout, "ShowReadout");
  show(form.showTrail, "ShowTrail");
  show(form.showHand, "ShowHand");
  this->connect(form.handSize, QOverload<double>::of(&QDoubleSpinBox::valueChanged), this,
    [this](double percent)
    {
      this->Manager->set("Size of the Hand", "HandSize", percent / 100.0);
      this->Manager->redraw();
    });
  this->connect(form.clutch, &QAbstractButton::clicked, this,
    [this](bool on) { this->Manager->set("Haptic Clutch", "Clutched", on); });
  this->connect(
    form.record, &QAbstractButton::clicked, this->Manager->recorder(), &pqHapticsRecorder::arm);
}

void pqHapticsPanel::connectCommands()
{
  Ui::pqHapticsPanel& form = *this->Form;
  pqHapticsManager* manager = this->Manager;
  this->connect(form.engage, &QAbstractButton::clicked, this,
    [this, manager](bool on)
    {
      manager->setEngaged(on);
      this->showSettings();
    });
  const auto command = [this, manager](QAbstractButton* button, const char* name)
  {
    this->connect(
      button, &QAbstractButton::clicked, manager, [manager, name] { manager->command(name); });
  };
  command(form.fit, "Fit");
  command(form.cancelBuild, "CancelBuild");
  command(form.dropLandmark, "DropLandmark");
  command(form.removeLandmark, "RemoveLastLandmark");
  command(form.clearLandmarks, "ClearLandmarks");
  this->connect(
    form.smaller, &QAbstractButton::clicked, this, [this] { this->scale(1.0 / WorkspaceStep); });
  this->connect(
    form.larger, &QAbstractButton::clicked, this, [this] { this->scale(WorkspaceStep); });
  this->connect(
    form.exportLandmarks, &QAbstractButton::clicked, this, &pqHapticsPanel::exportLandmarks);
}

void pqHapticsPanel::followScene()
{
  if (vtkSMProxy* scene = this->Manager->scene())
  {
    pqCoreUtilities::connect(scene, vtkCommand::PropertyModifiedEvent, this, SLOT(showSettings()));
  }
  this->showSettings();
  this->LastText.invalidate(); // what the scene before has reported is over
  this->showReadings();
}

void pqHapticsPanel::scale(double factor)
{
  if (vtkSMProxy* scene = this->Manager->scene())
  {
    vtkSMPropertyHelper(scene, "ScaleWorkspace").Set(factor);
    scene->UpdateProperty("ScaleWorkspace", 1); // even if it is the same factor again
    this->Manager->poll();
  }
}

void pqHapticsPanel::chooseDevice(int index)
{
  const QString name = this->Form->device->itemData(index).toString();
  if (name == ChooseFile)
  {
    this->chooseRecording();
  }
  else if (name == FindDevices)
  {
    this->findDevices();
  }
  else
  {
    this->Manager->setDevice(name);
  }
}

/// Adds what is plugged in to the chooser, each entry with its state next to it, and shows them.
void pqHapticsPanel::findDevices()
{
  QComboBox* chooser = this->Form->device;
  vtkNew<vtkStringArray> names;
  vtkNew<vtkStringArray> states;
  QApplication::setOverrideCursor(Qt::WaitCursor);
  vtkHapticDevice::ListDevices(names, states);
  QApplication::restoreOverrideCursor();
  for (vtkIdType i = 0; i < names->GetNumberOfValues(); ++i)
  {
    const QString name = QString::fromStdString(names->GetValue(i));
    int index = chooser->findData(name);
    if (index < 0)
    {
      const int kind = chooser->findData(name.section(':', 0, 0));
      index = kind + 1; // below its kind
      chooser->insertItem(
        index, QString("%1: %2").arg(chooser->itemText(kind), name.section(':', 1)), name);
    }
    chooser->setItemData(index, QString::fromStdString(states->GetValue(i)), Qt::ToolTipRole);
  }
  this->showDevice();
  chooser->showPopup();
}

/// The hand is at the client, so its files are.
void pqHapticsPanel::chooseRecording()
{
  auto* dialog = new pqFileDialog(nullptr, pqCoreUtilities::mainWidget(), "Play a Haptic Recording",
    QString(), PlayedFilter, false);
  dialog->setObjectName("HapticRecordingDialog");
  dialog->setFileMode(pqFileDialog::ExistingFile);
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  this->connect(dialog, &QDialog::accepted, this,
    [this, dialog]
    {
      this->Manager->setDevice(dialog->getSelectedFiles().value(0));
      this->showSettings();
    });
  this->connect(dialog, &QDialog::rejected, this, &pqHapticsPanel::showSettings);
  dialog->open();
}

void pqHapticsPanel::showSettings()
{
  Ui::pqHapticsPanel& form = *this->Form;
  this->showDevice();
  form.engage->setChecked(this->Manager->isEngaged());
  form.engage->setText(this->Manager->isEngaged() ? "Release" : "Engage");
  vtkSMProxy* scene = this->Manager->scene();
  for (QWidget* needsScene :
    { static_cast<QWidget*>(form.workspaceGroup), static_cast<QWidget*>(form.landmarksGroup) })
  {
    needsScene->setEnabled(scene != nullptr);
  }
  form.clutch->setChecked(scene && vtkSMPropertyHelper(scene, "Clutched").GetAsInt() != 0);
  form.landmarkDistance->setCurrentIndex(scene
      ? vtkSMPropertyHelper(scene, "LandmarkDistance").GetAsInt()
      : static_cast<int>(vtkHapticLandmarks::STRAIGHT));
  if (vtkSMProxy* values = this->Manager->values())
  {
    showValue(form.stiffness, vtkSMPropertyHelper(values, "Stiffness").GetAsDouble());
    showValue(form.maximumForce, vtkSMPropertyHelper(values, "MaximumForce").GetAsDouble());
    form.side->setCurrentIndex(vtkSMPropertyHelper(values, "Side").GetAsInt());
    form.showForce->setChecked(vtkSMPropertyHelper(values, "ShowForce").GetAsInt() != 0);
    form.showReadout->setChecked(vtkSMPropertyHelper(values, "ShowReadout").GetAsInt() != 0);
    form.showTrail->setChecked(vtkSMPropertyHelper(values, "ShowTrail").GetAsInt() != 0);
    form.showHand->setChecked(vtkSMPropertyHelper(values, "ShowHand").GetAsInt() != 0);
    showValue(form.handSize, 100.0 * vtkSMPropertyHelper(values, "HandSize").GetAsDouble());
  }
  this->showRecorder();
}

void pqHapticsPanel::showRecorder()
{
  const pqHapticsRecorder* recorder = this->Manager->recorder();
  this->Form->record->setChecked(recorder->isArmed());
  this->Form->recording->setText(recorder->state());
  this->Form->recording->setToolTip(recorder->file());
}

void pqHapticsPanel::showDevice()
{
  QComboBox* chooser = this->Form->device;
  const QString device = this->Manager->device();
  int index = chooser->findData(device);
  if (index < 0)
  {
    index = chooser->count() - LastEntries;
    chooser->insertItem(index, QFileInfo(device).fileName(), device);
  }
  chooser->setCurrentIndex(index);
}

void pqHapticsPanel::showReadings()
{
  this->showForce();
  this->showBuilding();
  const bool engaged = this->Manager->isEngaged();
  if (!engaged || !this->LastText.isValid() || this->LastText.elapsed() >= TextInterval)
  {
    this->LastText.start();
    this->showText();
    this->showContact();
    this->showRecorder();
  }
}

void pqHapticsPanel::showForce()
{
  QProgressBar* bar = this->Form->force;
  vtkPVHapticScene* scene = this->Manager->clientScene();
  const double force = scene ? scene->GetReadings()->GetForceMagnitude() : 0.0;
  vtkSMProxy* values = this->Manager->values();
  const double most = scene ? scene->GetScene()->GetServo()->GetEffectiveMaximumForce()
    : values                ? vtkSMPropertyHelper(values, "MaximumForce").GetAsDouble()
                            : 0.0;
  const double share = most > 0.0 ? std::min(force / most, 1.0) : 0.0;
  bar->setValue(static_cast<int>(share * bar->maximum()));
  bar->setFormat(number(force, 2) + " N of " + number(most, 1) + " N");
}

void pqHapticsPanel::showBuilding()
{
  vtkPVHapticScene* scene = this->Manager->clientScene();
  this->Form->building->setVisible(scene && scene->GetBuilding());
  if (scene && scene->GetBuilding())
  {
    this->Form->buildProgress->setValue(static_cast<int>(100.0 * scene->GetBuildProgress()));
  }
}

void pqHapticsPanel::showText()
{
  Ui::pqHapticsPanel& form = *this->Form;
  vtkPVHapticScene* scene = this->Manager->clientScene();
  if (!scene)
  {
    form.state->setText("Nothing is touched yet. Select a source and press Touch.");
    form.safeStiffness->clear();
    form.servo->clear();
    return;
  }
  const QString message = scene->GetMessage();
  const QString state = message.isEmpty() ? QString(scene->GetState()) : message;
  form.state->setText(state);
  form.state->setToolTip(state);

  vtkHapticServo* servo = scene->GetScene()->GetServo();
  vtkHapticReadings* readings = servo->GetReadings();
  const double limit = servo->GetStiffnessLimit();
  const bool isFelt = scene->GetReadings()->GetTouching() && readings->GetStiffness() > 0.0;
  const double stiffness = isFelt ? readings->GetStiffness() : servo->GetEffectiveStiffness();
  form.safeStiffness->setText((isFelt ? "in effect here " : "in effect ") + number(stiffness, 0) +
    " N/m" + (limit < VTK_DOUBLE_MAX ? "\nsafe up to " + number(limit, 0) + " N/m" : QString()));
  form.servo->setText(servo->GetNumberOfTicks() == 0 ? QString("not run yet")
                                                     : number(readings->GetMeasuredRate(), 0) +
        " Hz, gaps to " + number(1000.0 * readings->GetMaximumPeriod(), 1) + " ms\n" +
        QString::number(readings->GetNumberOfMissedTicks()) + " of " +
        QString::number(servo->GetNumberOfTicks()) + " missed");
}

void pqHapticsPanel::showContact()
{
  Ui::pqHapticsPanel& form = *this->Form;
  vtkPVHapticScene* scene = this->Manager->clientScene();
  vtkPVHapticReadings* hand = scene ? scene->GetReadings() : nullptr;
  const bool touching = hand && hand->GetTouching();
  const int landmarks = scene ? scene->GetRecords()->GetNumberOfLandmarks() : 0;
  const QString name = touching ? hand->GetTouchedName() : "";
  form.contact->setText(touching
      ? (name.isEmpty() ? name : name + ", ") + "cell " + QString::number(hand->GetTouchedCell()) +
        ", " + QString::number(hand->GetPenetration(), 'g', 3) + " world units deep"
      : QString("free space"));
  vtkStringArray* values = touching ? hand->GetProbedValues() : nullptr;
  const int rows = values ? static_cast<int>(values->GetNumberOfValues() / 2) : 0;
  form.values->setRowCount(rows);
  for (int row = 0; row < rows; ++row)
  {
    for (int column = 0; column < 2; ++column)
    {
      if (!form.values->item(row, column))
      {
        form.values->setItem(row, column, new QTableWidgetItem);
      }
      const QString text = QString::fromStdString(values->GetValue(2 * row + column));
      form.values->item(row, column)->setText(column == 1 ? shortened(text) : text);
      form.values->item(row, column)->setToolTip(text);
    }
  }
  const int free = scene ? scene->GetRecords()->GetNumberOfFreeLandmarks() : 0;
  const QString onNothing = free > 0 ? QString(", %1 on no surface").arg(free) : QString();
  form.landmarksGroup->setTitle(
    landmarks > 0 ? QString("Landmarks (%1%2)").arg(landmarks).arg(onNothing) : "Landmarks");
  form.dropLandmark->setEnabled(touching);
  form.removeLandmark->setEnabled(landmarks > 0);
  form.clearLandmarks->setEnabled(landmarks > 0);
  form.exportLandmarks->setEnabled(landmarks > 0);
}

void pqHapticsPanel::exportLandmarks()
{
  if (vtkHapticScene* hand = this->Manager->hand())
  {
    haptics::MakeLandmarksSource(hand->GetLandmarks()->GetOutput());
  }
}
