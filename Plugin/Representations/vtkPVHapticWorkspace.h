/**
 * @class   vtkPVHapticWorkspace
 * @brief   Where the reach of the device lies, as the properties of a proxy
 *
 * The workspace of a vtkHapticScene, which keeps a transform as long as neither the device nor the
 * view is another one. GUI thread.
 *
 * @sa vtkHapticWorkspace vtkPVHapticScene
 */
#ifndef Haptics_vtkPVHapticWorkspace_h
#define Haptics_vtkPVHapticWorkspace_h

#include "vtkPVHapticPart.h"

class vtkCamera;

class VTKHAPTICSREPRESENTATIONS_EXPORT vtkPVHapticWorkspace : public vtkPVHapticPart
{
public:
  static vtkPVHapticWorkspace* New();
  vtkTypeMacro(vtkPVHapticWorkspace, vtkPVHapticPart);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Device to world, row by row, as vtkHapticWorkspace::SetTransform(). All zeros, the default,
   * until it was set or fitted; set to zeros it is fitted anew when it is needed.
   */
  void SetTransform(const double matrix[16]);
  void GetTransform(double matrix[16]);
  ///@}
  /** As vtkHapticWorkspace::Fit(). */
  bool Fit(const double bounds[6], vtkCamera* camera);
  ///@{
  /** Whether it was set or fitted since it was forgotten: another view or device looks elsewhere.
   */
  vtkGetMacro(Chosen, bool);
  void Forget() { this->Chosen = false; }
  ///@}
  /** When it was set or fitted last; scaling and clutching do not count. */
  vtkMTimeType GetChosenTime() { return this->ChosenTime.GetMTime(); }

  /** Magnifies what the device reaches, as vtkHapticWorkspace::Scale(). */
  void Scale(double factor);
  ///@{
  /** The clutch, as vtkHapticWorkspace::SetClutched(). */
  void SetClutched(bool clutched);
  bool GetClutched();
  ///@}

protected:
  vtkPVHapticWorkspace();
  ~vtkPVHapticWorkspace() override;

private:
  vtkPVHapticWorkspace(const vtkPVHapticWorkspace&) = delete;
  void operator=(const vtkPVHapticWorkspace&) = delete;

  void Choose();

  bool Chosen = false;
  vtkTimeStamp ChosenTime;
};

#endif
