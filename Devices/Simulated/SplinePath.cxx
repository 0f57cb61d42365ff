#include "haptics/Devices/Simulated/SplinePath.h"

#include "vtkKochanekSpline.h"
#include "vtkNew.h"

#include <array>

namespace haptics
{
namespace
{
constexpr int SamplesPerSpan = 32;
}

bool RefineWithSpline(
  std::vector<DevicePoint>& points, std::vector<double>& times, std::string& error)
{
  std::array<vtkNew<vtkKochanekSpline>, 3> curves;
  std::vector<double> knots;
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    double knot = 0.0;
    if (!times.empty())
    {
      knot = times[i];
    }
    else if (i > 0)
    {
      knot = knots.back() + Distance(points[i - 1], points[i]);
    }
    if (!knots.empty() && knot <= knots.back())
    {
      continue; // a repeated point
    }
    knots.push_back(knot);
    for (int c = 0; c < 3; ++c)
    {
      curves[c]->AddPoint(knot, points[i][c]);
    }
  }
  if (knots.size() < 2)
  {
    error = "A spline needs at least two different points. Add points, or use Polyline.";
    return false;
  }

  std::vector<DevicePoint> samples;
  std::vector<double> sampleTimes;
  for (std::size_t span = 0; span + 1 < knots.size(); ++span)
  {
    const bool last = span + 2 == knots.size();
    for (int i = 0; i < SamplesPerSpan + (last ? 1 : 0); ++i)
    {
      const double step = (knots[span + 1] - knots[span]) / SamplesPerSpan;
      const double at = i == SamplesPerSpan ? knots[span + 1] : knots[span] + i * step;
      samples.push_back(
        { curves[0]->Evaluate(at), curves[1]->Evaluate(at), curves[2]->Evaluate(at) });
      sampleTimes.push_back(at);
    }
  }
  points.swap(samples);
  if (!times.empty())
  {
    times.swap(sampleTimes);
  }
  return true;
}
}
