#ifndef Haptics_BallTrial_h
#define Haptics_BallTrial_h

#include "Judge.h"
#include "haptics/Contact/GodObject.h"

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace haptics::testing
{
/// What came of a trial of a ball.
struct BallCount
{
  long Ticks = 0;
  long Contacts = 0;
  long Pieces = 0;
  long Overlaps = 0;  ///< a piece of the centre's way comes nearer than the ball's radius
  long Crossings = 0; ///< a piece crosses a triangle
  long Away = 0;      ///< a tick took it farther from the HIP
  long Rests = 0;     ///< it was left at rest and looked at
  long Phantoms = 0;  ///< held there though the straight way to the HIP is free for it
  long Stuck = 0;     ///< held there though a straight way leads nearer
  long Shrunk = 0;    ///< ticks with a ball that is smaller, as it overlaps
  long Overloads = 0;

  BallCount& operator+=(const BallCount& other);
  /// No overlap, crossing, motion away from the HIP or phantom, and at most 1 stuck in 10,000 that
  /// were left at rest (or one in fewer).
  bool IsGood() const;
};

/// @brief Leads a god-object that is a ball, with a judge of its own at its side: distances of
/// segments from triangles in long double, and what the directions from all that is touched leave
/// free by Hildreth's method. Surfaces stand still.
class BallTrial
{
public:
  /// `restEvery`: of so many contact ticks one is left at rest and looked at; 0: none.
  BallTrial(std::vector<TouchedSurface> surfaces, double radius, int restEvery);

  /// As in free space. In the frame of the first surface, as all positions here.
  void Place(const Vec3& position);
  void Tick(const Vec3& hip);
  /// What each tick's way is judged by: straight pieces of a centre that has to keep this radius.
  void JudgeWay(const Vec3* way, int corners, double radius, const Vec3& hip);
  const BallCount& Count() const { return this->Counted; }
  const GodObject& God() const { return this->Ball; }

  /// Called with each fault: its name, and from where to where a piece went or would have to go.
  std::function<void(const char* what, const Vec3& from, const Vec3& to, const Vec3& hip)> OnFault;

private:
  struct Part
  {
    std::shared_ptr<const TriangleSurface> Snapshot;
    std::shared_ptr<Judge> Surface;
    Vec3 Offset{};
    bool IsInsideOut = false;
  };

  void Lead(const Vec3& hip);
  void LookAtRest(const Vec3& hip);
  bool IsInside(const Part& part, const Vec3& x) const;
  double Distance(const Vec3& from, const Vec3& to, double reach) const;
  std::vector<Vec3> Normals(const Vec3& x, double reach) const;
  void Report(long& counter, const char* what, const Vec3& from, const Vec3& to, const Vec3& hip);

  std::vector<Part> Parts;
  GodObject Ball;
  double Radius;
  double Size = 0.0; ///< of the largest surface
  int RestEvery;
  int SinceRest = 0;
  Vec3 Now{};
  mutable std::vector<std::int32_t> Scratch;
  BallCount Counted;
};
}

#endif
