#include "vtkHapticReadings.h"

#include "haptics/Servo/SafetySettings.h"
#include "haptics/Servo/ServoStatistics.h"
#include "haptics/Tick/TickRecord.h"
#include "vtkObjectFactory.h"

#include <algorithm>
#include <cstddef>

class vtkHapticReadings::Internals
{
public:
  haptics::TickRecord Tick;
  haptics::ServoReport Report;
  bool IsLive = false;
  vtkTypeInt64 Halts = 0;
  vtkTypeInt64 LostRecords = 0;
};

namespace
{
constexpr double NanosecondsInSecond = 1e9;

void Copy(const haptics::Vec3& from, double to[3])
{
  std::copy(from.begin(), from.end(), to);
}

vtkTypeInt64 CountIn(const haptics::LogHistogram::Counts& counts, int bin)
{
  return bin < 0 || bin >= haptics::LogHistogram::NumberOfBins
    ? 0
    : static_cast<vtkTypeInt64>(counts[static_cast<std::size_t>(bin)]);
}
}

vtkStandardNewMacro(vtkHapticReadings);

vtkHapticReadings::vtkHapticReadings()
  : Internal(std::make_unique<Internals>())
{
}

vtkHapticReadings::~vtkHapticReadings() = default;

void vtkHapticReadings::Read(const haptics::TickRecord& tick, const haptics::ServoReport& report,
  bool isLive, vtkTypeInt64 halts, vtkTypeInt64 lostRecords)
{
  *this->Internal = { tick, report, isLive, halts, lostRecords };
}

void vtkHapticReadings::GetHapticInterfacePoint(double position[3])
{
  Copy(this->Internal->Tick.Hip, position);
}

void vtkHapticReadings::GetGodObject(double position[3])
{
  Copy(this->Internal->Tick.Position, position);
}

void vtkHapticReadings::GetForce(double force[3])
{
  Copy(this->Internal->Tick.Force, force);
}

void vtkHapticReadings::GetWorldForce(double force[3])
{
  Copy(this->Internal->Tick.WorldForce, force);
}

void vtkHapticReadings::GetDevicePosition(double position[3])
{
  Copy(this->Internal->Tick.DevicePosition, position);
}

unsigned int vtkHapticReadings::GetButtons()
{
  return this->Internal->Tick.Buttons;
}

double vtkHapticReadings::GetPenetration()
{
  return this->Internal->Tick.Penetration;
}

int vtkHapticReadings::GetNumberOfConstraints()
{
  return this->Internal->Tick.NumberOfConstraints;
}

double vtkHapticReadings::GetTime()
{
  return this->Internal->Tick.Time;
}

double vtkHapticReadings::GetStiffness()
{
  return this->Internal->Tick.Stiffness;
}

double vtkHapticReadings::GetObservedEnergy()
{
  return this->Internal->Tick.PassivityBalance;
}

double vtkHapticReadings::GetEnergyTank()
{
  return this->Internal->Tick.Tank;
}

unsigned int vtkHapticReadings::GetForceLimits()
{
  return this->Internal->Tick.Limits;
}

std::string vtkHapticReadings::DescribeForceLimits()
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
    { haptics::EnergyHeldBack, "energy tank" }, { haptics::DataAwaited, "waiting for data" } };
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

vtkTypeInt64 vtkHapticReadings::GetNumberOfMissedTicks()
{
  return static_cast<vtkTypeInt64>(this->Internal->Report.MissedTicks);
}

double vtkHapticReadings::GetMeasuredRate()
{
  return this->Internal->Report.Rate();
}

double vtkHapticReadings::GetMeanPeriod()
{
  return this->Internal->Report.MeanPeriod;
}

double vtkHapticReadings::GetPeriodRatio()
{
  return this->Internal->Report.PeriodRatio;
}

double vtkHapticReadings::GetMaximumPeriod()
{
  return this->Internal->Report.MaximumPeriod;
}

double vtkHapticReadings::GetPeriodQuantile(double fraction)
{
  return haptics::Quantile(this->Internal->Report.Periods, fraction);
}

double vtkHapticReadings::GetTickTimeQuantile(double fraction)
{
  return haptics::Quantile(this->Internal->Report.TickTimes, fraction);
}

double vtkHapticReadings::GetMaximumTickTime()
{
  return this->Internal->Report.MaximumTickTime;
}

int vtkHapticReadings::GetNumberOfHistogramBins()
{
  return haptics::LogHistogram::NumberOfBins;
}

double vtkHapticReadings::GetHistogramEdge(int bin)
{
  return bin < 0 || bin > haptics::LogHistogram::NumberOfBins
    ? 0.0
    : static_cast<double>(haptics::LogHistogram::LowerEdge(bin)) / NanosecondsInSecond;
}

vtkTypeInt64 vtkHapticReadings::GetPeriodCount(int bin)
{
  return CountIn(this->Internal->Report.Periods, bin);
}

vtkTypeInt64 vtkHapticReadings::GetTickTimeCount(int bin)
{
  return CountIn(this->Internal->Report.TickTimes, bin);
}

bool vtkHapticReadings::GetSqueezed()
{
  return this->Internal->IsLive && this->Internal->Tick.Status == haptics::UpdateStatus::Squeezed;
}

bool vtkHapticReadings::GetOverloaded()
{
  return this->Internal->IsLive && this->Internal->Tick.Status == haptics::UpdateStatus::Overloaded;
}

vtkTypeInt64 vtkHapticReadings::GetNumberOfTicks()
{
  return static_cast<vtkTypeInt64>(this->Internal->Report.Ticks);
}

vtkTypeInt64 vtkHapticReadings::GetNumberOfHalts()
{
  return this->Internal->Halts;
}

vtkTypeInt64 vtkHapticReadings::GetNumberOfLostRecords()
{
  return this->Internal->LostRecords;
}

void vtkHapticReadings::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  const haptics::TickRecord& tick = this->Internal->Tick;
  const haptics::ServoReport& report = this->Internal->Report;
  const auto print = [&os, indent](const char* name, const haptics::Vec3& v, const char* unit)
  { os << indent << name << ": (" << v[0] << ", " << v[1] << ", " << v[2] << ")" << unit << "\n"; };
  print("HapticInterfacePoint", tick.Hip, "");
  print("GodObject", tick.Position, "");
  print("Force", tick.Force, " N");
  os << indent << "Penetration: " << tick.Penetration << "\n";
  os << indent << "NumberOfConstraints: " << tick.NumberOfConstraints << "\n";
  os << indent << "Stiffness: " << tick.Stiffness << " N/m\n";
  os << indent << "ObservedEnergy: " << tick.PassivityBalance << " J\n";
  os << indent << "EnergyTank: " << tick.Tank << " J\n";
  os << indent << "ForceLimits: " << this->DescribeForceLimits() << "\n";
  os << indent << "Squeezed: " << (this->GetSqueezed() ? "yes" : "no") << "\n";
  os << indent << "Overloaded: " << (this->GetOverloaded() ? "yes" : "no") << "\n";
  os << indent << "NumberOfHalts: " << this->Internal->Halts << "\n";
  os << indent << "NumberOfTicks: " << report.Ticks << "\n";
  os << indent << "NumberOfMissedTicks: " << report.MissedTicks << "\n";
  os << indent << "MeasuredRate: " << report.Rate() << " Hz\n";
  os << indent << "PeriodRatio: " << report.PeriodRatio << " s\n";
  os << indent << "MaximumPeriod: " << report.MaximumPeriod << " s\n";
  os << indent << "NumberOfLostRecords: " << this->Internal->LostRecords << "\n";
}
