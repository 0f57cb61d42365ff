#ifndef Haptics_GodObjectMethod_h
#define Haptics_GodObjectMethod_h

#include "CertifiedMethod.h"
#include "haptics/Contact/GodObject.h"

namespace haptics::testing
{
/// A god-object as one of the methods that are compared. A template, as several are compiled.
template <class God>
class GodObjectMethod : public ContactMethod
{
public:
  explicit GodObjectMethod(const SurfaceList& surfaces)
    : Touched(surfaces.begin(), surfaces.end())
    , Point(std::make_unique<God>(Touched))
  {
  }
  void Place(const Vec3& position) override { this->Point->Place(position); }
  void Forget() override { this->Point = std::make_unique<God>(this->Touched); }
  Vec3 Update(const Vec3& hip) override
  {
    // The displacement keeps its digits; in free space it is exactly zero.
    const Vec3& displacement = this->Point->Update(hip).Displacement;
    return { hip[0] + displacement[0], hip[1] + displacement[1], hip[2] + displacement[2] };
  }

private:
  std::vector<TouchedSurface> Touched;
  std::unique_ptr<God> Point;
};
}

#endif
