/**
 * @class   vtkSimulatedHapticDevice
 * @brief   a device without hardware: a hand that follows a path, strokes a box or is led by code
 *
 * It behaves as a device that opens at once and never fails. By default its hand is as stiff as one
 * likes: it goes where the motion says, whatever the force; the force is kept and can be read back
 * with GetForce(). With BodyOn() it has mechanics and a hand that gives way: mass, friction, motors
 * and encoders, which the motion's point pulls by a spring and a damper (haptics::SimulatedBody).
 *
 * The position depends on the servo's times and forces alone, so that in virtual time
 * (vtkHapticServo::Step()) every run gives the same result.
 *
 * Four motions:
 * - Manual: stays where SetPosition() last put it.
 * - Polyline: goes straight from point to point of Path, at Speed, or at the times of Path's point
 *   array `Time` [s] if there is one.
 * - Spline: as Polyline, but along a smooth curve through the points (a Kochanek spline, tabulated
 *   when the device opens).
 * - Stroke: comes down onto StrokeBounds, strokes over them at PressDepth below their top, and goes
 *   up again, at Speed.
 *
 * At the end the hand stays at the last point. With Loop it goes straight back to the first point
 * at the path's mean speed and starts over.
 *
 * Motion, path, stroke and body are read by Open(); a change later takes effect at the next Open(),
 * which is the next Step() or Engage() of a scene: to stroke again, set another path and step.
 * SetPosition() and SetButtons() act at once. A path that cannot be followed and a setting that is
 * no number make Open() fail, with the cause in GetErrorMessage(), and the device stays Closed.
 *
 * All methods are for the GUI thread; none waits for the servo.
 */
#ifndef Haptics_vtkSimulatedHapticDevice_h
#define Haptics_vtkSimulatedHapticDevice_h

#include "vtkHapticDevice.h"

#include "vtkTimeStamp.h"

#include <array>
#include <string>

class vtkPolyData;

namespace haptics
{
class SimulatedPath;
}

class VTKHAPTICSDEVICES_EXPORT vtkSimulatedHapticDevice : public vtkHapticDevice
{
public:
  static vtkSimulatedHapticDevice* New();
  vtkTypeMacro(vtkSimulatedHapticDevice, vtkHapticDevice);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  bool NeedsPath() override { return true; }
  void FollowPath(vtkPolyData* path, double speed, bool loops) override;

  enum MotionType
  {
    Manual,
    Polyline,
    Spline,
    Stroke
  };
  enum StrokeType
  {
    Boustrophedon, ///< to and fro in parallel lines
    Lissajous      ///< one smooth closed curve
  };

  enum PresetType
  {
    Touch,
    Omni,
    Premium,
    Falcon
  };

  bool Open() override;
  void Close() override;
  bool HasChanged() override;

  ///@{
  /// What moves the hand, a MotionType. Default Manual.
  vtkSetClampMacro(Motion, int, Manual, Stroke);
  vtkGetMacro(Motion, int);
  void SetMotionToManual() { this->SetMotion(Manual); }
  void SetMotionToPolyline() { this->SetMotion(Polyline); }
  void SetMotionToSpline() { this->SetMotion(Spline); }
  void SetMotionToStroke() { this->SetMotion(Stroke); }
  ///@}

  ///@{
  /**
   * The points to follow, device frame [m]: those of its one line cell, in the cell's order, or
   * all of its points in their order if it has no lines. Finite; at least one point for Polyline,
   * two different ones for Spline. The point array `Time` [s], if there, must strictly increase.
   */
  virtual void SetPath(vtkPolyData* path);
  vtkGetObjectMacro(Path, vtkPolyData);
  ///@}

  ///@{
  /// How fast the hand goes along a path without times [m/s]. Default 0.05, finite and > 0.
  vtkSetMacro(Speed, double);
  vtkGetMacro(Speed, double);
  ///@}
  ///@{
  /// Start over at the end. Default off.
  vtkSetMacro(Loop, bool);
  vtkGetMacro(Loop, bool);
  vtkBooleanMacro(Loop, bool);
  ///@}

  ///@{
  /**
   * The box to stroke over, (xmin, xmax, ymin, ymax, zmin, zmax), device frame [m]. Default
   * (-0.05, 0.05, -0.05, 0.05, 0, 0); needs an extent in the two directions across StrokeAxis.
   */
  vtkSetVector6Macro(StrokeBounds, double);
  vtkGetVector6Macro(StrokeBounds, double);
  ///@}
  ///@{
  /// The axis down which the hand presses: 0, 1 or 2. Default 2.
  vtkSetClampMacro(StrokeAxis, int, 0, 2);
  vtkGetMacro(StrokeAxis, int);
  ///@}
  ///@{
  /// To and fro or a smooth curve, a StrokeType. Default Boustrophedon.
  vtkSetClampMacro(StrokePattern, int, Boustrophedon, Lissajous);
  vtkGetMacro(StrokePattern, int);
  ///@}
  ///@{
  /// Lines to and fro, or the lower of the curve's two frequencies. Default 8, from 1 to 1000.
  vtkSetClampMacro(NumberOfStrokes, int, 1, 1000);
  vtkGetMacro(NumberOfStrokes, int);
  ///@}
  ///@{
  /// How far the strokes are below the top of the bounds [m]. Default 0.005, finite.
  vtkSetMacro(PressDepth, double);
  vtkGetMacro(PressDepth, double);
  ///@}
  ///@{
  /// How far above the top of the bounds the hand starts and ends [m]. Default 0.01, >= 0.
  vtkSetMacro(StrokeClearance, double);
  vtkGetMacro(StrokeClearance, double);
  ///@}
  ///@{
  /// The share of the extent that strokes leave out at each side. Default 0.05, from 0 to 0.45.
  vtkSetClampMacro(StrokeInset, double, 0.0, 0.45);
  vtkGetMacro(StrokeInset, double);
  ///@}

  ///@{
  /**
   * Put the hand of the Manual motion somewhere, device frame [m]. It is there at the servo's next
   * tick. Default (0, 0, 0). A coordinate that is not finite is an error and changes nothing.
   */
  void SetPosition(double x, double y, double z);
  void SetPosition(const double position[3]);
  ///@}
  /// Hold buttons, in any motion: bit i stands for button i. Default 0.
  void SetButtons(unsigned int buttons);

  /// Time of one pass of the motion as it was opened [s]; 0 for Manual or while not open.
  double GetDuration() const;
  /**
   * Where the motion as it was opened is at a servo time [s], device frame [m]; for Manual where
   * SetPosition() put it. False, leaving the position as it is, while the device is not open.
   */
  bool GetPositionAt(double time, double position[3]) const;

  ///@{
  /**
   * The limits that this device claims to have. Defaults: 3.3 N, 1000 N/m, a box of 160 by 120 by
   * 70 mm around the origin, 2 buttons. Motions may leave the box. Damping [N s/m] is, until it is
   * set, what it takes to hold MaximumStiffness K without shaking at 1 kHz, K T / 2 (Colgate and
   * Schenkel 1997), so 0.5; a stiffness beyond vtkHapticSafety's margin of 2 Damping / T is not
   * rendered.
   */
  vtkSetClampMacro(MaximumForce, double, 0.0, VTK_DOUBLE_MAX);
  void SetMaximumStiffness(double value);
  void SetDamping(double value);
  vtkSetVector6Macro(WorkspaceBounds, double);
  vtkSetClampMacro(NumberOfButtons, int, 0, 32);
  ///@}

  ///@{
  /// Whether the motion pulls a body instead of being followed to the point. Default off.
  vtkSetMacro(Body, bool);
  vtkGetMacro(Body, bool);
  vtkBooleanMacro(Body, bool);
  ///@}
  ///@{
  /// Mass at the tip [kg]. Default 0.045; 0.0001 to 10. Its viscous friction is Damping.
  vtkSetClampMacro(Mass, double, 0.0001, 10.0);
  vtkGetMacro(Mass, double);
  ///@}
  ///@{
  /// Coulomb friction of each axis [N]: what it takes to move it from rest. Default 0; 0 to 10.
  vtkSetClampMacro(CoulombFriction, double, 0.0, 10.0);
  vtkGetMacro(CoulombFriction, double);
  ///@}
  ///@{
  /// Step of the measured position [m]. Default 0: exact; to 0.001.
  vtkSetClampMacro(EncoderResolution, double, 0.0, 0.001);
  vtkGetMacro(EncoderResolution, double);
  ///@}
  ///@{
  /// How late a force acts [s]: always by Delay, and by up to Jitter more, at random but the same
  /// in every run. Default 0; 0 to 0.05. Latency is their sum.
  vtkSetClampMacro(Delay, double, 0.0, 0.05);
  vtkGetMacro(Delay, double);
  vtkSetClampMacro(Jitter, double, 0.0, 0.05);
  vtkGetMacro(Jitter, double);
  ///@}
  ///@{
  /// How firmly the hand holds: a spring [N/m] to the motion's point and a damper [N s/m] against
  /// its velocity. Default 100 and 2; 0 (let go) to 10,000 and to 100.
  vtkSetClampMacro(HandStiffness, double, 0.0, 10000.0);
  vtkGetMacro(HandStiffness, double);
  vtkSetClampMacro(HandDamping, double, 0.0, 100.0);
  vtkGetMacro(HandDamping, double);
  ///@}
  /**
   * Body, limits and workspace of a real device, a PresetType; turns Body on. The hand stays.
   *
   * Largest force, mass, friction, encoder step and workspace of Touch, Omni and Premium 1.5 are
   * those of the maker's data sheets, remembered and not checked again: 3.3 N, 45 g, 0.26 N, 55 um
   * and 8.5 N, 75 g, 0.04 N, 30 um. The Falcon's force, encoder step (400 dpi) and 4-inch cube are
   * its maker's; its mass (0.25 kg) and friction (0.5 N) are published nowhere and assumed. The
   * largest stiffness is what common haptics software claims for each: 400, 700, 800, 3000 N/m. No
   * maker states a viscous friction; it is taken as the one that just holds that stiffness at 1
   * kHz.
   */
  void SetPreset(int preset);

protected:
  vtkSimulatedHapticDevice();
  ~vtkSimulatedHapticDevice() override;

private:
  vtkSimulatedHapticDevice(const vtkSimulatedHapticDevice&) = delete;
  void operator=(const vtkSimulatedHapticDevice&) = delete;

  bool CheckNumbers(std::string& error);
  bool MakePath(haptics::SimulatedPath& path, std::string& error);

  class SimulatedChannel;

  int Motion = Manual;
  vtkPolyData* Path = nullptr;
  double Speed = 0.05;
  bool Loop = false;
  double StrokeBounds[6] = { -0.05, 0.05, -0.05, 0.05, 0.0, 0.0 };
  int StrokeAxis = 2;
  int StrokePattern = Boustrophedon;
  int NumberOfStrokes = 8;
  double PressDepth = 0.005;
  double StrokeClearance = 0.01;
  double StrokeInset = 0.05;
  bool DampingIsSet = false;
  bool Body = false;
  double Mass = 0.045;
  double CoulombFriction = 0.0;
  double EncoderResolution = 0.0;
  double Delay = 0.0;
  double Jitter = 0.0;
  double HandStiffness = 100.0;
  double HandDamping = 2.0;
  vtkTimeStamp OpenTime; // of the settings
  std::array<double, 3> ManualPosition{};
  unsigned int ManualButtons = 0;
  std::shared_ptr<SimulatedChannel> Simulated;
};

#endif
