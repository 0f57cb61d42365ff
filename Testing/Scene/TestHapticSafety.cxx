#include "SceneTestTools.h"
#include "vtkHapticSafety.h"

#include "vtkNew.h"

#include <gtest/gtest.h>

#include <cmath>

namespace
{
struct Limit
{
  const char* Name;
  void (vtkHapticSafety::*Set)(double);
  void (vtkHapticSafety::*Loosen)(double);
  double (vtkHapticSafety::*Get)();
  double Default;
  double Stricter;
  double Looser;
  double Outside;
};

const Limit Limits[] = {
  { "SlewLimit", &vtkHapticSafety::SetSlewLimit, &vtkHapticSafety::LoosenSlewLimit,
    &vtkHapticSafety::GetSlewLimit, 1000.0, 100.0, 5000.0, 2e5 },
  { "SoftStartTime", &vtkHapticSafety::SetSoftStartTime, &vtkHapticSafety::LoosenSoftStartTime,
    &vtkHapticSafety::GetSoftStartTime, 0.1, 1.0, 0.0, -0.1 },
  { "StiffnessMargin", &vtkHapticSafety::SetStiffnessMargin,
    &vtkHapticSafety::LoosenStiffnessMargin, &vtkHapticSafety::GetStiffnessMargin, 0.9, 0.5, 2.0,
    101.0 },
  { "WatchdogTime", &vtkHapticSafety::SetWatchdogTime, &vtkHapticSafety::LoosenWatchdogTime,
    &vtkHapticSafety::GetWatchdogTime, 0.025, 0.01, 0.5, 2.0 },
  { "MissedTickShare", &vtkHapticSafety::SetMissedTickShare,
    &vtkHapticSafety::LoosenMissedTickShare, &vtkHapticSafety::GetMissedTickShare, 0.5, 0.1, 2.0,
    61.0 },
};

TEST(HapticSafety, IsNotLoosenedBySetting)
{
  for (const Limit& limit : Limits)
  {
    vtkNew<vtkHapticSafety> safety;
    EventCounter errors(safety, vtkCommand::ErrorEvent);
    EXPECT_EQ((safety->*limit.Get)(), limit.Default) << limit.Name;
    (safety->*limit.Set)(limit.Looser);
    EXPECT_EQ((safety->*limit.Get)(), limit.Default) << limit.Name;
    EXPECT_EQ(errors.Count, 1) << limit.Name;
    (safety->*limit.Set)(limit.Stricter);
    EXPECT_EQ((safety->*limit.Get)(), limit.Stricter) << limit.Name;
    EXPECT_FALSE(safety->IsLoosened()) << limit.Name;
    (safety->*limit.Loosen)(limit.Looser);
    EXPECT_EQ((safety->*limit.Get)(), limit.Looser) << limit.Name;
    EXPECT_TRUE(safety->IsLoosened()) << limit.Name;
    EXPECT_EQ(errors.Count, 1) << limit.Name;
  }
}

TEST(HapticSafety, RefusesWhatIsOutOfRangeOrNoNumber)
{
  for (const Limit& limit : Limits)
  {
    vtkNew<vtkHapticSafety> safety;
    EventCounter errors(safety, vtkCommand::ErrorEvent);
    for (const double bad : { limit.Outside, std::nan(""), -1.0 })
    {
      (safety->*limit.Set)(bad);
      (safety->*limit.Loosen)(bad);
    }
    EXPECT_EQ(errors.Count, 6) << limit.Name;
    EXPECT_EQ((safety->*limit.Get)(), limit.Default) << limit.Name;
  }
}

TEST(HapticSafety, GoesBackToItsDefaults)
{
  vtkNew<vtkHapticSafety> safety;
  for (const Limit& limit : Limits)
  {
    (safety->*limit.Loosen)(limit.Looser);
  }
  safety->SetContactDamping(1.0);
  safety->PassivityControlOn();
  safety->Reset();
  for (const Limit& limit : Limits)
  {
    EXPECT_EQ((safety->*limit.Get)(), limit.Default) << limit.Name;
  }
  EXPECT_EQ(safety->GetContactDamping(), 0.0);
  EXPECT_FALSE(safety->GetPassivityControl());
}
}
