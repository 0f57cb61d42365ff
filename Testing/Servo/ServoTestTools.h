#ifndef Haptics_ServoTestTools_h
#define Haptics_ServoTestTools_h

#include "haptics/Contact/GodObject.h"
#include "haptics/Devices/DeviceChannel.h"
#include "haptics/Math/Vec3.h"
#include "haptics/Surface/TriangleSurface.h"

#include <algorithm>
#include <atomic>
#include <functional>
#include <memory>
#include <string>
#include <vector>

/// A square of two triangles in the plane z = `height`, touched from above [world unit].
///
///     (-s, s) o-------o (s, s)
///             |     / |
///             |   /   |
///             | /     |
///    (-s, -s) o-------o (s, -s)
inline std::shared_ptr<const haptics::TriangleSurface> MakePlane(
  double height = 0.0, double size = 1.0)
{
  haptics::TriangleMesh mesh;
  mesh.Points = { { -size, -size, height }, { size, -size, height }, { size, size, height },
    { -size, size, height } };
  mesh.Triangles = { { 0, 1, 2 }, { 0, 2, 3 } };
  haptics::SurfaceOptions options;
  options.TouchedSide = haptics::Side::Front;
  options.Engine = haptics::EngineKind::BruteForce;
  std::string error;
  return haptics::TriangleSurface::Build(std::move(mesh), options, error);
}

inline std::unique_ptr<haptics::GodObject> MakeGodObject(
  std::shared_ptr<const haptics::TriangleSurface> surface)
{
  return std::make_unique<haptics::GodObject>(
    std::vector<haptics::TouchedSurface>{ std::move(surface) });
}

/// A device whose every answer the test decides. `Hand` runs in the servo's thread.
class ScriptedChannel : public haptics::DeviceChannel
{
public:
  std::function<bool(double time, haptics::DeviceSample& sample)> Hand;
  haptics::Vec3 LastForce{ -1.0, -1.0, -1.0 }; ///< read it only while no servo thread runs
  std::atomic<int> Writes{ 0 };

  bool Read(double time, haptics::DeviceSample& sample) noexcept override
  {
    return this->Hand(time, sample);
  }
  void Write(const std::array<double, 3>& force) noexcept override
  {
    this->LastForce = force;
    this->Writes.fetch_add(1);
  }
};

/// A hand that comes down onto z = 0 at 0.1 m/s and stays `depth` [m] below it.
inline std::shared_ptr<ScriptedChannel> MakePressingHand(double depth)
{
  auto channel = std::make_shared<ScriptedChannel>();
  channel->Hand = [depth](double time, haptics::DeviceSample& sample)
  {
    sample.Position = { 0.0, 0.0, std::max(0.005 - 0.1 * time, -depth) };
    return true;
  };
  return channel;
}

inline const haptics::Vec3 NoForce{ 0.0, 0.0, 0.0 };

#endif
