#include "vtkSimulatedHapticDevice.h"

#include "haptics/Devices/DeviceRegistry.h"
#include "haptics/Devices/LatestValue.h"
#include "haptics/Devices/MonitoredChannel.h"
#include "haptics/Devices/Simulated/SimulatedBody.h"
#include "haptics/Devices/Simulated/SimulatedPath.h"
#include "haptics/Devices/Simulated/SplinePath.h"
#include "haptics/Devices/Simulated/StrokePattern.h"

#include "vtkCellArray.h"
#include "vtkDataArray.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <utility>
#include <vector>

/// The servo thread's end. The motion is a table of positions, or the point that the GUI thread set
/// last; the hand is there, or pulls a body there.
class vtkSimulatedHapticDevice::SimulatedChannel : public haptics::MonitoredChannel
{
public:
  SimulatedChannel(bool led, haptics::SimulatedPath path, const haptics::DeviceSample& hand,
    std::unique_ptr<haptics::SimulatedBody> body)
    : Led(led)
    , Path(std::move(path))
    , Body(std::move(body))
    , Hand(hand)
  {
  }

  void MoveHand(const haptics::DeviceSample& hand) { this->Hand.Publish(hand); }
  bool IsLed() const { return this->Led; }
  const haptics::SimulatedPath& GetPath() const { return this->Path; }

protected:
  bool ReadDevice(double time, haptics::DeviceSample& sample) noexcept override
  {
    this->Hand.Update();
    sample = this->Hand.Get();
    if (!this->Led)
    {
      sample.Position = this->Path.At(time);
    }
    if (this->Body)
    {
      // A servo's time starts anew at each start; so does the body.
      if (!this->IsPlaced || time < this->Body->GetTime())
      {
        this->Body->Place(time, sample.Position);
        this->IsPlaced = true;
      }
      if (this->MustLetGo.load(std::memory_order_relaxed) &&
        this->MustLetGo.exchange(false, std::memory_order_acq_rel))
      {
        // When it was halted is not known in the servo's time: since the last tick.
        this->Body->Ask({});
      }
      this->Body->Advance(time, sample.Position);
      sample.Position = this->Body->GetMeasuredPosition();
    }
    return true;
  }

  // Without a body the hand is held by the motion: MonitoredChannel keeps the force, nothing moves.
  void WriteDevice(const std::array<double, 3>& force) noexcept override
  {
    if (this->Body)
    {
      this->Body->Ask(force);
    }
  }
  void HaltDevice() noexcept override { this->MustLetGo.store(true, std::memory_order_release); }

private:
  const bool Led;
  const haptics::SimulatedPath Path;
  const std::unique_ptr<haptics::SimulatedBody> Body; // null: the hand is as stiff as one likes
  bool IsPlaced = false;
  std::atomic<bool> MustLetGo{ false };
  haptics::LatestValue<haptics::DeviceSample> Hand;
};

vtkStandardNewMacro(vtkSimulatedHapticDevice);

namespace
{
const haptics::DeviceRegistration Registration("simulated", "Simulated stroke",
  []() -> vtkHapticDevice* { return vtkSimulatedHapticDevice::New(); });
}
vtkCxxSetObjectMacro(vtkSimulatedHapticDevice, Path, vtkPolyData);

namespace
{
/// The points to follow and, if the array is there, their times.
bool ReadPolyData(vtkPolyData* data, std::vector<haptics::DevicePoint>& points,
  std::vector<double>& times, std::string& error)
{
  if (!data || data->GetNumberOfPoints() == 0)
  {
    error = "The motion needs a path with points. Call SetPath() with one before Open().";
    return false;
  }
  vtkCellArray* lines = data->GetLines();
  const vtkIdType numberOfLines = lines ? lines->GetNumberOfCells() : 0;
  if (numberOfLines > 1)
  {
    error = "The path has " + std::to_string(numberOfLines) +
      " line cells, but a hand follows one. Join them, for instance with vtkStripper.";
    return false;
  }
  vtkNew<vtkIdList> ids;
  if (numberOfLines == 1)
  {
    lines->GetCellAtId(0, ids);
  }
  else
  {
    ids->SetNumberOfIds(data->GetNumberOfPoints());
    for (vtkIdType i = 0; i < ids->GetNumberOfIds(); ++i)
    {
      ids->SetId(i, i);
    }
  }

  vtkDataArray* time = data->GetPointData()->GetArray("Time");
  if (time && time->GetNumberOfComponents() != 1)
  {
    error = "The path's point array Time has " + std::to_string(time->GetNumberOfComponents()) +
      " components. It must have one, the time in seconds.";
    return false;
  }
  if (time && time->GetNumberOfTuples() != data->GetNumberOfPoints())
  {
    error = "The path's point array Time has " + std::to_string(time->GetNumberOfTuples()) +
      " values for " + std::to_string(data->GetNumberOfPoints()) +
      " points. It must have one for each.";
    return false;
  }
  for (vtkIdType i = 0; i < ids->GetNumberOfIds(); ++i)
  {
    haptics::DevicePoint point;
    data->GetPoint(ids->GetId(i), point.data());
    points.push_back(point);
    if (time)
    {
      times.push_back(time->GetComponent(ids->GetId(i), 0));
    }
  }
  return true;
}

/// The least with which a spring that is sampled at 1 kHz makes no energy [N s/m].
double DampingFor(double stiffness)
{
  constexpr double ServoPeriod = 0.001; // [s]
  return 0.5 * stiffness * ServoPeriod;
}
}

vtkSimulatedHapticDevice::vtkSimulatedHapticDevice()
{
  this->MaximumForce = 3.3;
  this->MaximumStiffness = 1000.0;
  this->Damping = DampingFor(this->MaximumStiffness);
  this->NumberOfButtons = 2;
  this->SetWorkspaceBounds(-0.08, 0.08, -0.06, 0.06, -0.035, 0.035);
}

vtkSimulatedHapticDevice::~vtkSimulatedHapticDevice()
{
  this->SetPath(nullptr);
}

void vtkSimulatedHapticDevice::SetMaximumStiffness(double value)
{
  value = std::clamp(value, 0.0, VTK_DOUBLE_MAX); // NaN stays: Open() reports it
  if (this->MaximumStiffness != value)
  {
    this->MaximumStiffness = value;
    this->Modified();
  }
  if (!this->DampingIsSet)
  {
    this->Damping = DampingFor(this->MaximumStiffness);
  }
}

void vtkSimulatedHapticDevice::SetDamping(double value)
{
  value = std::clamp(value, 0.0, VTK_DOUBLE_MAX);
  this->DampingIsSet = true;
  if (this->Damping != value)
  {
    this->Damping = value;
    this->Modified();
  }
}

bool vtkSimulatedHapticDevice::Open()
{
  if (this->IsOpen())
  {
    return true;
  }
  this->SetState(Opening);
  haptics::SimulatedPath path;
  std::string error;
  if (!this->CheckNumbers(error) || (this->Motion != Manual && !this->MakePath(path, error)))
  {
    this->Fail(Closed, error);
    return false;
  }
  std::unique_ptr<haptics::SimulatedBody> body;
  if (this->Body)
  {
    body = std::make_unique<haptics::SimulatedBody>(haptics::BodyParameters{ this->Mass,
      this->Damping, this->CoulombFriction, this->EncoderResolution, this->MaximumForce,
      this->Delay, this->Jitter, this->HandStiffness, this->HandDamping });
  }
  this->Latency = this->Body ? this->Delay + this->Jitter : 0.0;
  this->Simulated = std::make_shared<SimulatedChannel>(this->Motion == Manual, std::move(path),
    haptics::DeviceSample{ this->ManualPosition, this->ManualButtons }, std::move(body));
  this->BecomeReady(this->Simulated);
  this->OpenTime.Modified(); // the last: opening has changed the state
  return true;
}

bool vtkSimulatedHapticDevice::HasChanged()
{
  const bool hasPath = this->Path && (this->Motion == Polyline || this->Motion == Spline);
  return this->IsOpen() &&
    (this->GetMTime() > this->OpenTime.GetMTime() ||
      (hasPath && this->Path->GetMTime() > this->OpenTime.GetMTime()));
}

void vtkSimulatedHapticDevice::SetPreset(int preset)
{
  struct Numbers
  {
    double MaximumForce;     // [N]
    double MaximumStiffness; // [N/m]
    double Mass;             // [kg]
    double Coulomb;          // [N]
    double Encoder;          // [m]
    double HalfWorkspace[3]; // [m]
    int Buttons;
  };
  // Sources: see SetPreset() in the header.
  static const Numbers presets[] = {
    { 3.3, 400.0, 0.045, 0.26, 55e-6, { 0.080, 0.060, 0.035 }, 2 },
    { 3.3, 700.0, 0.045, 0.26, 55e-6, { 0.080, 0.060, 0.035 }, 2 },
    { 8.5, 800.0, 0.075, 0.04, 30e-6, { 0.1905, 0.1335, 0.0955 }, 1 },
    { 8.0, 3000.0, 0.25, 0.5, 63.5e-6, { 0.0508, 0.0508, 0.0508 }, 4 },
  };
  if (preset < Touch || preset > Falcon)
  {
    vtkErrorMacro("There is no preset " << preset << "; give Touch, Omni, Premium or Falcon (0 to "
                                        << Falcon << "). Nothing has changed.");
    return;
  }
  const Numbers& numbers = presets[preset];
  this->Body = true;
  this->MaximumForce = numbers.MaximumForce;
  this->MaximumStiffness = numbers.MaximumStiffness;
  this->Damping = DampingFor(numbers.MaximumStiffness);
  this->DampingIsSet = false;
  this->Mass = numbers.Mass;
  this->CoulombFriction = numbers.Coulomb;
  this->EncoderResolution = numbers.Encoder;
  const double* half = numbers.HalfWorkspace;
  const double bounds[6] = { -half[0], half[0], -half[1], half[1], -half[2], half[2] };
  std::copy(bounds, bounds + 6, this->WorkspaceBounds);
  this->NumberOfButtons = numbers.Buttons;
  this->Modified();
}

void vtkSimulatedHapticDevice::Close()
{
  this->BecomeClosed();
}

// Setters clamp, but NaN is within no bounds.
bool vtkSimulatedHapticDevice::CheckNumbers(std::string& error)
{
  const std::pair<const char*, double> numbers[] = { { "MaximumForce", this->MaximumForce },
    { "MaximumStiffness", this->MaximumStiffness }, { "Damping", this->Damping },
    { "Mass", this->Mass }, { "CoulombFriction", this->CoulombFriction },
    { "EncoderResolution", this->EncoderResolution }, { "Delay", this->Delay },
    { "Jitter", this->Jitter }, { "HandStiffness", this->HandStiffness },
    { "HandDamping", this->HandDamping } };
  for (const auto& [name, value] : numbers)
  {
    if (std::isnan(value))
    {
      error =
        std::string("The simulated device's ") + name + " is not a number. Set it, then open.";
      return false;
    }
  }
  return true;
}

bool vtkSimulatedHapticDevice::MakePath(haptics::SimulatedPath& path, std::string& error)
{
  std::vector<haptics::DevicePoint> points;
  std::vector<double> times;
  if (this->Motion == Stroke)
  {
    haptics::StrokePattern pattern;
    std::copy(this->StrokeBounds, this->StrokeBounds + 6, pattern.Bounds.begin());
    pattern.Axis = this->StrokeAxis;
    pattern.Depth = this->PressDepth;
    pattern.Clearance = this->StrokeClearance;
    pattern.Inset = this->StrokeInset;
    pattern.NumberOfStrokes = this->NumberOfStrokes;
    pattern.Pattern = this->StrokePattern == Lissajous ? haptics::StrokePattern::Lissajous
                                                       : haptics::StrokePattern::Boustrophedon;
    points = pattern.Points(error);
    if (points.empty())
    {
      return false;
    }
  }
  else if (!ReadPolyData(this->Path, points, times, error))
  {
    return false;
  }

  const auto follow = [&]
  {
    return times.empty() ? path.FollowAtSpeed(points, this->Speed, this->Loop, error)
                         : path.FollowTimes(points, times, this->Loop, error);
  };
  // Followed as it is first: that checks what the spline may rely on.
  if (!follow())
  {
    return false;
  }
  if (this->Motion == Spline)
  {
    return haptics::RefineWithSpline(points, times, error) && follow();
  }
  return true;
}

void vtkSimulatedHapticDevice::SetPosition(double x, double y, double z)
{
  const std::array<double, 3> position{ x, y, z };
  if (!haptics::IsFinite(position))
  {
    vtkErrorMacro("The position (" << x << ", " << y << ", " << z
                                   << ") m is not finite; the hand stays where it is.");
    return;
  }
  this->ManualPosition = position;
  if (this->IsOpen())
  {
    this->Simulated->MoveHand({ this->ManualPosition, this->ManualButtons });
  }
}

void vtkSimulatedHapticDevice::SetPosition(const double position[3])
{
  this->SetPosition(position[0], position[1], position[2]);
}

void vtkSimulatedHapticDevice::SetButtons(unsigned int buttons)
{
  this->ManualButtons = buttons;
  if (this->IsOpen())
  {
    this->Simulated->MoveHand({ this->ManualPosition, this->ManualButtons });
  }
}

double vtkSimulatedHapticDevice::GetDuration() const
{
  return this->IsOpen() ? this->Simulated->GetPath().Duration() : 0.0;
}

bool vtkSimulatedHapticDevice::GetPositionAt(double time, double position[3]) const
{
  if (!this->IsOpen())
  {
    return false;
  }
  const haptics::DevicePoint point =
    this->Simulated->IsLed() ? this->ManualPosition : this->Simulated->GetPath().At(time);
  std::copy(point.begin(), point.end(), position);
  return true;
}

void vtkSimulatedHapticDevice::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  static const char* const motions[] = { "Manual", "Polyline", "Spline", "Stroke" };
  static const char* const patterns[] = { "Boustrophedon", "Lissajous" };
  const double* bounds = this->StrokeBounds;
  os << indent << "Motion: " << motions[this->Motion] << "\n";
  os << indent << "Path: " << this->Path << "\n";
  os << indent << "Speed: " << this->Speed << " m/s\n";
  os << indent << "Loop: " << (this->Loop ? "on" : "off") << "\n";
  os << indent << "StrokeBounds: (" << bounds[0] << ", " << bounds[1] << ", " << bounds[2] << ", "
     << bounds[3] << ", " << bounds[4] << ", " << bounds[5] << ") m\n";
  os << indent << "StrokeAxis: " << this->StrokeAxis << "\n";
  os << indent << "StrokePattern: " << patterns[this->StrokePattern] << "\n";
  os << indent << "NumberOfStrokes: " << this->NumberOfStrokes << "\n";
  os << indent << "PressDepth: " << this->PressDepth << " m\n";
  os << indent << "StrokeClearance: " << this->StrokeClearance << " m\n";
  os << indent << "StrokeInset: " << this->StrokeInset << "\n";
  os << indent << "Body: " << (this->Body ? "on" : "off") << "\n";
  os << indent << "Mass: " << this->Mass << " kg\n";
  os << indent << "CoulombFriction: " << this->CoulombFriction << " N\n";
  os << indent << "EncoderResolution: " << this->EncoderResolution << " m\n";
  os << indent << "Delay: " << this->Delay << " s\n";
  os << indent << "Jitter: " << this->Jitter << " s\n";
  os << indent << "HandStiffness: " << this->HandStiffness << " N/m\n";
  os << indent << "HandDamping: " << this->HandDamping << " N s/m\n";
  os << indent << "ManualPosition: (" << this->ManualPosition[0] << ", " << this->ManualPosition[1]
     << ", " << this->ManualPosition[2] << ") m\n";
  os << indent << "ManualButtons: " << this->ManualButtons << "\n";
  os << indent << "Duration: " << this->GetDuration() << " s\n";
}

void vtkSimulatedHapticDevice::FollowPath(vtkPolyData* path, double speed, bool loops)
{
  this->Close();
  this->SetPath(path);
  this->SetSpeed(speed);
  this->SetLoop(loops);
  this->SetMotionToPolyline();
}
