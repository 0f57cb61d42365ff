#ifndef Haptics_Trial_h
#define Haptics_Trial_h

#include "Judge.h"
#include "haptics/Contact/GodObject.h"

#include <functional>
#include <memory>
#include <random>
#include <vector>

namespace haptics::testing
{
/// @brief What leads a point after a HIP, and is tried.
class Follower
{
public:
  virtual ~Follower() = default;
  /// Puts the point somewhere as in free space; returns where that is, rounded.
  virtual Vec3 Place(const Vec3& position) = 0;
  /// One tick: the corners of the way that the point makes, from where it was; `goal` becomes the
  /// HIP as it was understood, rounded.
  virtual const std::vector<Vec3>& Follow(const Vec3& hip, Vec3& goal) = 0;
  /// Whether it answers for where it is: not where it could not look at all there was.
  virtual bool Answers() const { return true; }
  /// Unit directions away from what holds it; may be empty.
  virtual std::vector<Vec3> Supports() const { return {}; }
};

/// The project's god-object; in the local frame of its first surface.
class GodObjectFollower : public Follower
{
public:
  explicit GodObjectFollower(
    std::vector<TouchedSurface> surfaces, int substepLimit = GodObject::DefaultSubstepLimit);
  Vec3 Place(const Vec3& position) override;
  const std::vector<Vec3>& Follow(const Vec3& hip, Vec3& goal) override;
  bool Answers() const override;
  std::vector<Vec3> Supports() const override;
  const GodObject& God() const { return this->Point; }

private:
  GodObject Point;
  std::vector<Vec3> Corners;
};

enum class Fault
{
  Crossing, ///< a piece of the way crosses a triangle
  Graze,    ///< a piece comes upon a two-sided triangle within its very plane
  Gap,      ///< a way does not start where the last one ended
  Away,     ///< a tick took the point farther from the HIP
  Phantom,  ///< held in plain view of the HIP, at rest too
  Stuck,    ///< lifted a little and pressed again it comes nearer
  Balance,  ///< as stuck, but where it is no straight way leads nearer: on a knife's edge, no fault
  NumberOfFaults
};
const char* NameOf(Fault fault);

struct Finding
{
  Fault What = Fault::Crossing;
  Vec3 From{};  ///< start of the piece or tick
  Vec3 To{};    ///< end of it
  Vec3 Hip{};   ///< as understood
  int Part = 0; ///< which surface
  std::int32_t Triangle = -1;
  double Share = 0.0; ///< Stuck: how much nearer it came, of the distance
};

struct TrialCount
{
  long Ticks = 0;    ///< all, those at rest included
  long Contacts = 0; ///< ticks that end away from the HIP
  long Pieces = 0;
  long Views = 0;   ///< contact ticks asked whether the HIP is in plain view
  long Presses = 0; ///< contact ticks lifted and pressed again
  long Unanswered = 0;
  long Faults[static_cast<int>(Fault::NumberOfFaults)] = {};

  long& operator[](Fault fault) { return this->Faults[static_cast<int>(fault)]; }
  long operator[](Fault fault) const { return this->Faults[static_cast<int>(fault)]; }
  TrialCount& operator+=(const TrialCount& other);
};

/// @brief Takes what follows a HIP, tick by tick, and judges its way.
///
/// A tick that leaves the point in plain view of the HIP, farther than so many clearances, is given
/// some more at rest; if it is held in plain view still, that is a phantom. Of every so many
/// contact ticks one is pressed again: from 30 clearances higher, in six slightly different ways,
/// and if in five of them it comes more than 2 % nearer, it was stuck: or it balanced, as over the
/// rim of a sheet that the HIP is in the very plane of, where every straight way from it either is
/// not free or leads away from the HIP.
class Trial
{
public:
  struct Part
  {
    std::shared_ptr<const Judge> Surface;
    Vec3 Offset{};           ///< of its frame, in that of ways
    double Negligible = 0.0; ///< a coordinate smaller than that is 0 in its frame
  };
  struct Settings
  {
    double Clearance = 0.0;  ///< how near to surfaces the point can be at best [world unit]
    double Resolution = 0.0; ///< what a HIP is rounded to [world unit]
    double Clearances = 16;  ///< nearer to the HIP than so many is at the HIP
    int Rest = 8;            ///< ticks at rest before a phantom is one
    int PressEvery = 10;     ///< contact ticks; 0: never
    unsigned Seed = 1;
  };

  /// `probe` follows like `follower`, and is pressed in its place.
  Trial(std::vector<Part> parts, Follower& follower, Follower& probe, const Settings& settings);

  /// Of a god-object's surfaces, none of which moves.
  static std::vector<Part> PartsOf(const std::vector<TouchedSurface>& surfaces);
  /// With what is known of their clearance and rounding.
  static Settings SettingsOf(const std::vector<TouchedSurface>& surfaces);

  /// Called for each fault.
  std::function<void(const Finding&)> OnFault;
  /// Called after each tick of the follower, those at rest included: from where to where.
  std::function<void(const Vec3& before, const Vec3& now, const Vec3& goal)> OnTick;

  /// False, and nothing is placed, where that is on a triangle: on neither side of it.
  bool Place(const Vec3& position);
  void Tick(const Vec3& hip);
  const TrialCount& Count() const { return this->Counted; }
  const Vec3& Position() const { return this->Now; }

  bool Crosses(const Vec3& from, const Vec3& to) const;
  /// Whether a way crosses nothing, and comes upon no triangle within its plane.
  bool IsFree(const Vec3& from, const Vec3& to) const;
  bool IsInPlainView(const Vec3& goal, const Vec3& eye) const;
  /// Whether a way is free with some roundings to spare.
  bool IsWellFree(const Vec3& from, const Vec3& to) const;

private:
  /// One tick of the follower, its way judged.
  void Lead(const Vec3& hip);
  bool IsFarFromGoal() const;
  void LookForPhantom(const Vec3& hip);
  void PressAgain(const Vec3& hip);
  /// Puts the probe a little away from what holds the point. False where no such way is free.
  bool Lift(int attempt, double height);
  /// Whether a straight way of `length` along a facet there, or two, is free and leads nearer to
  /// the HIP. `reach`: facets within that count.
  bool HasDescent(double reach, double length) const;
  void Report(Finding finding);
  Vec3 LocalOf(const Part& part, const Vec3& x) const;

  std::vector<Part> Parts;
  Follower& Tried;
  Follower& Probe;
  Settings Set;
  std::mt19937 Random;
  TrialCount Counted;
  bool IsPlaced = false;
  Vec3 Now{};
  Vec3 Goal{};
  long SincePress = 0;
};
}

#endif
