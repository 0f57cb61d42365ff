#ifndef Haptics_Succession_h
#define Haptics_Succession_h

#include "haptics/Contact/SceneGodObject.h"

namespace haptics
{
/// @brief Has a god-object start where another one stands, when the surfaces have changed.
class Succession
{
public:
  /// `now` takes the place of `previous`.
  Succession(SceneGodObject& now, const SceneGodObject& previous)
    : Now(now)
    , Previous(previous)
    , God(now.God)
    , Before(previous.God)
  {
  }

  /// As GodObject::Continue().
  bool Run();

private:
  bool TakeOver();
  bool Continue();
  bool GoesOn(std::int32_t surface, const TouchedSurface& then) const;
  const WorkingSet* FindPredecessor(std::int32_t surface, bool& isSame) const;
  void StayInContact();
  void Land();
  void Settle();
  bool HasSameMaterial() const;

  SceneGodObject& Now;
  const SceneGodObject& Previous;
  GodObjectState& God;
  const GodObjectState& Before;
};
}

#endif
