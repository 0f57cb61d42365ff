/**
 * @class   pqHapticsPanel
 * @brief   The dock panel of the hand: device, material, workspace, contact, landmarks, recorder.
 *
 * Shows the scene of pqHapticsManager and edits its proxy. Settings follow the proxy wherever they
 * are changed; readings are shown as the manager looks at the scene: the force bar at each look,
 * text ten times a second. GUI thread.
 *
 * @sa pqHapticsManager pqHapticsToolBar
 */
#ifndef Haptics_pqHapticsPanel_h
#define Haptics_pqHapticsPanel_h

#include <QDockWidget>
#include <QElapsedTimer>

#include <memory>

namespace Ui
{
class pqHapticsPanel;
}
class pqHapticsManager;

class pqHapticsPanel : public QDockWidget
{
  Q_OBJECT
  using Superclass = QDockWidget;

public:
  explicit pqHapticsPanel(QWidget* parent = nullptr, Qt::WindowFlags flags = Qt::WindowFlags());
  ~pqHapticsPanel() override;

private Q_SLOTS:
  void followScene();
  void showSettings();
  void showReadings();

private:
  Q_DISABLE_COPY(pqHapticsPanel)

  void connectSettings();
  void connectCommands();
  void chooseDevice(int index);
  void findDevices();
  void chooseRecording();
  void scale(double factor);
  void showDevice();
  void showForce();
  void showBuilding();
  void showText();
  void showContact();
  void showRecorder();
  void exportLandmarks();

  std::unique_ptr<Ui::pqHapticsPanel> Form;
  pqHapticsManager* Manager;
  QElapsedTimer LastText;
};

#endif
