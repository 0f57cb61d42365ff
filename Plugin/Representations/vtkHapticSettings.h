/**
 * @class   vtkHapticSettings
 * @brief   What a new haptic scene of ParaView's window begins with: the page Haptics of Edit >
 * Settings
 *
 * Plain values behind the proxy (settings, HapticSettings). Touch in ParaView's window takes them
 * over where it makes a scene; scripts and state files do not, so that they do the same whatever a
 * user has chosen there. GUI thread.
 *
 * @sa vtkSMHapticSceneProxy
 */
#ifndef Haptics_vtkHapticSettings_h
#define Haptics_vtkHapticSettings_h

#include "vtkHapticsRepresentationsModule.h"
#include "vtkObject.h"

#include <string>

class VTKHAPTICSREPRESENTATIONS_EXPORT vtkHapticSettings : public vtkObject
{
public:
  static vtkHapticSettings* New();
  vtkTypeMacro(vtkHapticSettings, vtkObject);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /** As vtkPVHapticScene::SetDeviceName(); empty, the default: the one that was used last. */
  vtkSetMacro(Device, std::string);
  vtkGetMacro(Device, std::string);
  ///@}
  ///@{
  /** As those of vtkPVHapticScene. Defaults: 500 N/m, 3.3 N, automatic side. */
  vtkSetMacro(Stiffness, double);
  vtkGetMacro(Stiffness, double);
  vtkSetMacro(MaximumForce, double);
  vtkGetMacro(MaximumForce, double);
  vtkSetMacro(Side, int);
  vtkGetMacro(Side, int);
  ///@}
  ///@{
  /** What the view shows in addition to the hand: force (default on), data (off), trail (off). */
  vtkSetMacro(ShowForce, bool);
  vtkGetMacro(ShowForce, bool);
  vtkSetMacro(ShowReadout, bool);
  vtkGetMacro(ShowReadout, bool);
  vtkSetMacro(ShowTrail, bool);
  vtkGetMacro(ShowTrail, bool);
  ///@}
  ///@{
  /** The hand itself: default on, and of 0.012 of the view's height. */
  vtkSetMacro(ShowHand, bool);
  vtkGetMacro(ShowHand, bool);
  vtkSetMacro(HandSize, double);
  vtkGetMacro(HandSize, double);
  ///@}

protected:
  vtkHapticSettings() = default;
  ~vtkHapticSettings() override = default;

private:
  vtkHapticSettings(const vtkHapticSettings&) = delete;
  void operator=(const vtkHapticSettings&) = delete;

  std::string Device;
  double Stiffness = 500.0;
  double MaximumForce = 3.3;
  int Side = 2;
  bool ShowForce = true;
  bool ShowReadout = false;
  bool ShowTrail = false;
  bool ShowHand = true;
  double HandSize = 0.012;
};

#endif
