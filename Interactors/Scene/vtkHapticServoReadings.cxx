// What vtkHapticServo tells: its latest tick, its statistics, its print-out.
#include "vtkHapticServo.h"

#include "haptics/Servo/SafetySettings.h"
#include "haptics/Servo/ServoStatistics.h"
#include "haptics/Tick/TickRecord.h"
#include "vtkHapticSafety.h"

#include "vtkHapticDevice.h"

#include <algorithm>
#include <string>

namespace
{
constexpr double NanosecondsInSecond = 1e9;

void Copy(const haptics::Vec3& from, double to[3])
{
  std::copy(from.begin(), from.end(), to);
}
}

const char* vtkHapticServo::GetStateAsString()
{
  static const char* const names[] = { "Stopped", "Running", "Stepping", "DeviceLost",
    "InvalidPosition", "InvalidForce", "Stalled", "Overrun", "Interrupted" };
  return names[this->State];
}

void vtkHapticServo::GetHapticInterfacePoint(double position[3])
{
  Copy(this->GetLatestRecord().Hip, position);
}

void vtkHapticServo::GetGodObject(double position[3])
{
  Copy(this->GetLatestRecord().Position, position);
}

void vtkHapticServo::GetForce(double force[3])
{
  Copy(this->GetLatestRecord().Force, force);
}

void vtkHapticServo::GetWorldForce(double force[3])
{
  Copy(this->GetLatestRecord().WorldForce, force);
}

void vtkHapticServo::GetDevicePosition(double position[3])
{
  Copy(this->GetLatestRecord().DevicePosition, position);
}

unsigned int vtkHapticServo::GetButtons()
{
  return this->GetLatestRecord().Buttons;
}

double vtkHapticServo::GetPenetration()
{
  return this->GetLatestRecord().Penetration;
}

int vtkHapticServo::GetNumberOfConstraints()
{
  return this->GetLatestRecord().NumberOfConstraints;
}

double vtkHapticServo::GetTime()
{
  return this->GetLatestRecord().Time;
}

vtkTypeInt64 vtkHapticServo::GetNumberOfTicks()
{
  return static_cast<vtkTypeInt64>(this->GetReport().Ticks);
}

vtkTypeInt64 vtkHapticServo::GetNumberOfMissedTicks()
{
  return static_cast<vtkTypeInt64>(this->GetReport().MissedTicks);
}

double vtkHapticServo::GetMeasuredRate()
{
  return this->GetReport().Rate();
}

double vtkHapticServo::GetMeanPeriod()
{
  return this->GetReport().MeanPeriod;
}

double vtkHapticServo::GetPeriodRatio()
{
  return this->GetReport().PeriodRatio;
}

double vtkHapticServo::GetMaximumPeriod()
{
  return this->GetReport().MaximumPeriod;
}

double vtkHapticServo::GetPeriodQuantile(double fraction)
{
  return haptics::Quantile(this->GetReport().Periods, fraction);
}

double vtkHapticServo::GetTickTimeQuantile(double fraction)
{
  return haptics::Quantile(this->GetReport().TickTimes, fraction);
}

double vtkHapticServo::GetMaximumTickTime()
{
  return this->GetReport().MaximumTickTime;
}

int vtkHapticServo::GetNumberOfHistogramBins()
{
  return haptics::LogHistogram::NumberOfBins;
}

double vtkHapticServo::GetHistogramEdge(int bin)
{
  return bin < 0 || bin > haptics::LogHistogram::NumberOfBins
    ? 0.0
    : static_cast<double>(haptics::LogHistogram::LowerEdge(bin)) / NanosecondsInSecond;
}

vtkTypeInt64 vtkHapticServo::GetPeriodCount(int bin)
{
  return bin < 0 || bin >= haptics::LogHistogram::NumberOfBins
    ? 0
    : static_cast<vtkTypeInt64>(this->GetReport().Periods[static_cast<std::size_t>(bin)]);
}

vtkTypeInt64 vtkHapticServo::GetTickTimeCount(int bin)
{
  return bin < 0 || bin >= haptics::LogHistogram::NumberOfBins
    ? 0
    : static_cast<vtkTypeInt64>(this->GetReport().TickTimes[static_cast<std::size_t>(bin)]);
}

double vtkHapticServo::GetCurrentStiffness()
{
  return this->GetLatestRecord().Stiffness;
}

double vtkHapticServo::GetObservedEnergy()
{
  return this->GetLatestRecord().PassivityBalance;
}

double vtkHapticServo::GetEnergyTank()
{
  return this->GetLatestRecord().Tank;
}

unsigned int vtkHapticServo::GetForceLimits()
{
  return this->GetLatestRecord().Limits;
}

std::string vtkHapticServo::DescribeForceLimits()
{
  struct Name
  {
    haptics::SafetyLimit Bit;
    const char* Text;
  };
  static const Name names[] = { { haptics::ForceClamped, "largest force" },
    { haptics::ForceSlewed, "slew limit" }, { haptics::SoftStarted, "soft start" },
    { haptics::StiffnessLimited, "stiffness limit" },
    { haptics::PassivityDamped, "passivity control" }, { haptics::PausedForce, "paused" },
    { haptics::EnergyHeldBack, "energy tank" } };
  std::string text;
  for (const Name& name : names)
  {
    if ((this->GetForceLimits() & name.Bit) != 0)
    {
      text += (text.empty() ? "" : ", ") + std::string(name.Text);
    }
  }
  return text;
}

void vtkHapticServo::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  const haptics::TickRecord& tick = this->GetLatestRecord();
  const haptics::ServoReport report = this->GetReport();
  const auto print = [&os, indent](const char* name, const haptics::Vec3& v, const char* unit)
  { os << indent << name << ": (" << v[0] << ", " << v[1] << ", " << v[2] << ")" << unit << "\n"; };
  os << indent << "Device: " << this->Device.Get() << "\n";
  os << indent << "Rate: " << this->Rate << " Hz\n";
  os << indent << "RealTimePriority: " << (this->RealTimePriority ? "on" : "off") << "\n";
  os << indent << "PriorityNote: " << this->PriorityNote << "\n";
  os << indent << "StallLimit: " << this->StallLimit << " s\n";
  os << indent << "Stiffness: " << this->Stiffness << " N/m, in effect "
     << this->GetEffectiveStiffness() << " N/m\n";
  os << indent << "MaximumForce: " << this->MaximumForce << " N, in effect "
     << this->GetEffectiveMaximumForce() << " N\n";
  os << indent << "Paused: " << (this->Paused ? "yes" : "no") << "\n";
  os << indent << "DevicePaced: " << (this->DevicePaced ? "on" : "off") << "\n";
  os << indent << "RecordingFileName: " << this->RecordingFileName << "\n";
  os << indent << "State: " << this->GetStateAsString() << "\n";
  os << indent << "ErrorMessage: " << this->ErrorMessage << "\n";
  print("HapticInterfacePoint", tick.Hip, "");
  print("GodObject", tick.Position, "");
  print("Force", tick.Force, " N");
  os << indent << "Penetration: " << tick.Penetration << "\n";
  os << indent << "NumberOfConstraints: " << tick.NumberOfConstraints << "\n";
  os << indent << "CurrentStiffness: " << tick.Stiffness << " N/m\n";
  os << indent << "ObservedEnergy: " << tick.PassivityBalance << " J\n";
  os << indent << "EnergyTank: " << tick.Tank << " J\n";
  os << indent << "ForceLimits: " << this->DescribeForceLimits() << "\n";
  os << indent << "NumberOfHalts: " << this->GetNumberOfHalts() << "\n";
  os << indent << "NumberOfTicks: " << report.Ticks << "\n";
  os << indent << "NumberOfMissedTicks: " << report.MissedTicks << "\n";
  os << indent << "MeasuredRate: " << report.Rate() << " Hz\n";
  os << indent << "PeriodRatio: " << report.PeriodRatio << " s\n";
  os << indent << "MaximumPeriod: " << report.MaximumPeriod << " s\n";
  os << indent << "NumberOfLostRecords: " << this->GetNumberOfLostRecords() << "\n";
  os << indent << "Safety:\n";
  this->GetSafety()->PrintSelf(os, indent.GetNextIndent());
}
