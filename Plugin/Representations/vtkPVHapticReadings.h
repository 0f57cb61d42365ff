/**
 * @class   vtkPVHapticReadings
 * @brief   What the hand of a vtkPVHapticScene does just now, as the properties of a proxy
 *
 * As of the scene's last Update() or Step(); zeros before. GUI thread.
 *
 * @sa vtkHapticReadings vtkPVHapticScene
 */
#ifndef Haptics_vtkPVHapticReadings_h
#define Haptics_vtkPVHapticReadings_h

#include "vtkNew.h"
#include "vtkPVHapticPart.h"

class vtkStringArray;

class VTKHAPTICSREPRESENTATIONS_EXPORT vtkPVHapticReadings : public vtkPVHapticPart
{
public:
  static vtkPVHapticReadings* New();
  vtkTypeMacro(vtkPVHapticReadings, vtkPVHapticPart);

  ///@{
  /** As the scene and its servo report them. */
  double GetRate(); ///< [Hz]; 0 when released
  vtkTypeInt64 GetMissedTicks();
  double GetEffectiveStiffness();                    ///< what the device can hold of it [N/m]
  double* GetForce() VTK_SIZEHINT(3);                ///< [N], world axes
  double GetForceMagnitude();                        ///< [N]
  double GetPenetration();                           ///< [world unit]
  double* GetHapticInterfacePoint() VTK_SIZEHINT(3); ///< [world unit]
  double* GetGodObject() VTK_SIZEHINT(3);            ///< [world unit]
  bool GetTouching();
  vtkIdType GetTouchedCell(); ///< id of the cell in the source's data where known; else -1
  ///@}
  /** Which of the representations is touched, by the order they were added in; else -1. */
  int GetTouchedRepresentation();
  /** What it is called; empty where nothing is touched, or without a name. */
  const char* GetTouchedName();
  /** For each array its name and its value at the contact, as text. */
  vtkStringArray* GetProbedValues();

protected:
  vtkPVHapticReadings();
  ~vtkPVHapticReadings() override;

private:
  vtkPVHapticReadings(const vtkPVHapticReadings&) = delete;
  void operator=(const vtkPVHapticReadings&) = delete;

  vtkNew<vtkStringArray> Probed;
};

#endif
