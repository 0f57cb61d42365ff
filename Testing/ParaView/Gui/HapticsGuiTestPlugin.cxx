// Loaded into ParaView with the plugin Haptics: runs the tests as soon as ParaView is up, and
// ends ParaView with the number of those that failed.
#include "HapticsGuiTest.h"

#include "pqActiveObjects.h"
#include "pqCoreUtilities.h"
#include "vtkPVDynamicInitializerPluginInterface.h"
#include "vtkPVPlugin.h"

#include <QApplication>
#include <QTest>
#include <QTimer>

namespace
{
constexpr int LookInterval = 200; // [ms]

void runWhenUp()
{
  if (pqCoreUtilities::mainWidget() && pqCoreUtilities::mainWidget()->isVisible() &&
    pqActiveObjects::instance().activeView())
  {
    // Names of tests in the environment, so that one can be run alone.
    QStringList arguments(QApplication::applicationName());
    arguments += QString(qgetenv("HAPTICS_GUI_TESTS")).split(' ', Qt::SkipEmptyParts);
    HapticsGuiTest test;
    QApplication::exit(QTest::qExec(&test, arguments));
  }
  else
  {
    QTimer::singleShot(LookInterval, runWhenUp);
  }
}
}

class HapticsGuiTestPlugin
  : public vtkPVPlugin
  , public vtkPVDynamicInitializerPluginInterface
{
public:
  const char* GetPluginName() override { return "HapticsGuiTest"; }
  const char* GetPluginVersionString() override { return "1.0"; }
  bool GetRequiredOnServer() override { return false; }
  bool GetRequiredOnClient() override { return true; }
  const char* GetRequiredPlugins() override { return "Haptics"; }
  const char* GetDescription() override { return "Tests the plugin Haptics."; }
  const char* GetEULA() override { return nullptr; }
  void GetBinaryResources(std::vector<std::string>&) override {}
  void Initialize() override { QTimer::singleShot(LookInterval, runWhenUp); }
};

PV_PLUGIN_EXPORT(HapticsGuiTest, HapticsGuiTestPlugin)
