#include "CertifiedMethod.h"

namespace haptics::testing
{
namespace
{
class CertifiedMethod : public ContactMethod
{
public:
  CertifiedMethod(const SurfaceList& surfaces, int passes, double tip)
    : Surfaces(surfaces.begin(), surfaces.end())
    , Passes(passes)
    , Radius(tip)
  {
    this->Forget();
  }
  void Place(const Vec3& position) override { this->Point->Place(position); }
  void Forget() override
  {
    this->Point =
      std::make_unique<GodObject>(this->Surfaces, this->Radius > 0.0 ? Tip::Ball : Tip::Point);
    this->Point->SetPassLimit(this->Passes);
    this->Point->SetTipRadius(this->Radius);
  }
  Vec3 Update(const Vec3& hip) override
  {
    // The displacement keeps its digits; in free space it is exactly zero.
    const Vec3& displacement = this->Point->Update(hip).Displacement;
    return { hip[0] + displacement[0], hip[1] + displacement[1], hip[2] + displacement[2] };
  }

private:
  std::vector<TouchedSurface> Surfaces;
  int Passes;
  double Radius;
  std::unique_ptr<GodObject> Point;
};
}

MethodPointer MakeCertified(const SurfaceList& surfaces, int passes, double tip)
{
  return std::make_unique<CertifiedMethod>(surfaces, passes, tip);
}
}
