// How much of a contact hangs on how often the hand is sampled, and what it costs to mend that.
#include "AnalyticSurfaces.h"
#include "BenchmarkSurfaces.h"
#include "FirstHit.h"
#include "MeshToPolyData.h"
#include "RandomVectors.h"
#include "Statistics.h"

#include "vtkNew.h"
#include "vtkQuadricDecimation.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <random>
#include <sstream>
#include <string>

using namespace haptics;
using namespace haptics::testing;

namespace
{
const char* const Help = R"(Compares contacts with those of a hand that moves slowly.

HapticsWayBenchmark [--surfaces FOLDER] [--only NAME,NAME...] [--speeds V,V...] [--depths D,D...]
                    [--limits N,N...] [--uniform N,N...] [--tips R,R...] [--strokes N] [--seed N]
                    [--quick] [--times]

A HIP strokes a surface as large as in the hand (radius 50 mm) at a steady speed [m/s] and depth
[mm] under its smoothed height, a place a millisecond, 900 places a stroke. Every method touches
along all strokes. A tick is apart where its god-object lies over 1 mm from the converged one: the
same HIP goes its straight way within each tick in 32 steps, 64, ... up to 1024, until two traces of
the stroke agree to 0.1 mm in every tick.

--surfaces  folder with the real surfaces (default build/surfaces)
--only      names of surfaces (default fault,pial,aneurysm,footbones,t13,gearbox,wing,sphere); sphere6
            has 81,920 triangles in place of 20,480, and so on
--speeds    default 0.05,0.2,0.5      --depths  default 2,5
--limits    most substeps of a tick (GodObject::SetSubstepLimit; default 1,2,4,8,16)
--uniform   as many equal steps in every tick instead (default 4,16)
--tips      radii of balls [mm] (default 0.5,1,3; none: no ball)
--strokes   of each surface, speed and depth (default 20)
--quick     without the rows "moved" and "rate", which take most of the time
--times     only what a tick costs, of the point and of each ball in turns: a row for each radius
            [mm], with the ratios to the point's mean and 99th percentile, and the mean and 99th
            percentile of how many facets lie within reach of where a tick begins

Prints CSV: surface, speed, depth, method ("substeps" or "steps"), its number, contact ticks, the
share of them that is apart [%], mean, 99th and 99.9th percentile of the time of a tick [us]. Each
tick's time is the least of three runs. Row "converged": the most steps that a stroke took, and the
share of ticks that were still elsewhere in half as many. Rows "moved": the converged god-object of a
hand that is 1 um or 55 um aside. Rows "rate": the same hand sampled at so many Hz, with the largest
of --limits, against the converged one at 4 kHz; "rate in one step": without substeps. Row "detail":
the converged god-object on half the triangles (quadric decimation). Rows "tip 0.5", "tip 1" and
"tip 3": a ball of so many millimetres in 1, 4 and 16 equal steps, against its own converged trace;
"tip converged 0.5" ...: as "converged". Rows "ball ...": as the point's, of a ball of 1 mm in one
step.
)";

constexpr double InHand = 0.05;    // radius of a surface in the hand [m]
constexpr double Smoothing = 5e-3; // of a surface's height, along the hand's way [m]
constexpr double Apart = 1e-3;     // [m]
constexpr int TicksOfStroke = 900;
constexpr int TimedRuns = 5;    // with --times
constexpr double Ball = 1e-3;   // radius of the tip that is looked at closely [m]
constexpr int Finest = 4;       // places of the HIP a millisecond
constexpr int MostSteps = 1024; // of a tick's way

struct Options
{
  std::string Folder = "build/surfaces";
  std::vector<std::string> Names = { "fault", "pial", "aneurysm", "footbones", "t13", "gearbox",
    "wing", "sphere" };
  std::vector<double> Speeds = { 0.05, 0.2, 0.5 };
  std::vector<double> Depths = { 2, 5 };
  std::vector<double> Limits = { 1, 2, 4, 8, 16 };
  std::vector<double> Uniform = { 4, 16 };
  std::vector<double> Tips = { 0.5, 1, 3 }; // [mm]
  int Strokes = 20;
  bool IsQuick = false;
  bool IsTimed = false;
  unsigned Seed = 1;
};

[[noreturn]] void Fail(const std::string& why)
{
  std::fprintf(stderr, "%s. --help says how it is used.\n", why.c_str());
  std::exit(2);
}

std::vector<std::string> Split(const std::string& text)
{
  std::vector<std::string> words;
  std::istringstream stream(text);
  for (std::string word; std::getline(stream, word, ',');)
  {
    words.push_back(word);
  }
  return words;
}

std::vector<double> Numbers(const std::string& text)
{
  std::vector<double> numbers;
  for (const std::string& word : Split(text))
  {
    char* end = nullptr;
    numbers.push_back(std::strtod(word.c_str(), &end));
    if (*end != 0 || word.empty() || !(numbers.back() > 0.0))
    {
      Fail("'" + word + "' is not a number above 0");
    }
  }
  return numbers;
}

Options Read(int argc, char** argv)
{
  Options options;
  for (int i = 1; i < argc; ++i)
  {
    const std::string word = argv[i];
    if (word == "--help")
    {
      std::fputs(Help, stdout);
      std::exit(0);
    }
    if (word == "--quick")
    {
      options.IsQuick = true;
      continue;
    }
    if (word == "--times")
    {
      options.IsTimed = true;
      continue;
    }
    if (i + 1 == argc)
    {
      Fail(word + " needs a value");
    }
    const std::string value = argv[++i];
    if (word == "--surfaces")
    {
      options.Folder = value;
    }
    else if (word == "--only")
    {
      options.Names = Split(value);
    }
    else if (word == "--speeds")
    {
      options.Speeds = Numbers(value);
    }
    else if (word == "--depths")
    {
      options.Depths = Numbers(value);
    }
    else if (word == "--limits")
    {
      options.Limits = Numbers(value);
    }
    else if (word == "--uniform")
    {
      options.Uniform = Numbers(value);
    }
    else if (word == "--tips")
    {
      options.Tips = value == "none" ? std::vector<double>() : Numbers(value);
    }
    else if (word == "--strokes")
    {
      options.Strokes = static_cast<int>(Numbers(value).at(0));
    }
    else if (word == "--seed")
    {
      options.Seed = static_cast<unsigned>(Numbers(value).at(0));
    }
    else
    {
      Fail("There is no option " + word);
    }
  }
  return options;
}

/// A hand that wanders over a surface at a steady speed and depth.
class Stroke
{
public:
  Stroke(const std::shared_ptr<const TriangleSurface>& surface, bool isAbove, unsigned seed)
    : Ray({ surface })
    , IsAbove(isAbove)
    , Random(seed)
  {
    this->Outwards = Unit(NormalVector(this->Random));
    this->Along = Unit(Cross(this->Outwards, NormalVector(this->Random)));
    this->Place = { 0.4 * InHand * this->Outwards[0], 0.4 * InHand * this->Outwards[1], 0.0 };
    this->Along = isAbove ? Unit({ this->Along[0], this->Along[1], 0.0 }) : this->Along;
    this->Smoothed = this->Height();
  }

  /// Places of the HIP, `Finest` a millisecond.
  std::vector<Vec3> Make(double speed, double depth)
  {
    std::vector<Vec3> hips;
    const double step = speed * 1e-3 / Finest;
    double above = 5e-3;
    for (int i = 0; i < TicksOfStroke * Finest; ++i)
    {
      this->Go(step);
      this->Smoothed += -std::expm1(-step / Smoothing) * (this->Height() - this->Smoothed);
      above = std::max(-depth, above - 1e-4 / Finest);
      const double height = this->Smoothed + above;
      hips.push_back(
        this->IsAbove ? Vec3{ this->Place[0], this->Place[1], height } : height * this->Outwards);
    }
    return hips;
  }

private:
  void Go(double step)
  {
    const double turn = 4.0 * std::sqrt(step) * NormalVector(this->Random)[0];
    if (this->IsAbove)
    {
      this->Along = Unit(this->Along + turn * Cross({ 0, 0, 1 }, this->Along));
      for (int k = 0; k < 2; ++k)
      {
        if (std::abs(this->Place[k] + step * this->Along[k]) > 0.5 * InHand)
        {
          this->Along[k] = -this->Along[k];
        }
        this->Place[k] += step * this->Along[k];
      }
      return;
    }
    this->Along = Unit(this->Along + turn * Cross(this->Outwards, this->Along));
    const Vec3 from = this->Outwards;
    const double angle = step / std::max(this->Smoothed, 0.2 * InHand);
    this->Outwards = Unit(from + angle * this->Along);
    this->Along = Unit(this->Along - angle * from);
  }

  double Height()
  {
    const double far = 2.0 * InHand;
    if (this->IsAbove)
    {
      const Vec3 top{ this->Place[0], this->Place[1], far };
      return far - FirstHit(this->Ray, top, { this->Place[0], this->Place[1], -far });
    }
    return far - FirstHit(this->Ray, far * this->Outwards, { 0, 0, 0 });
  }

  GodObject Ray;
  bool IsAbove;
  std::mt19937 Random;
  Vec3 Outwards{}, Along{}, Place{};
  double Smoothed = 0.0;
};

template <class T>
std::vector<T> EveryNth(const std::vector<T>& all, int n)
{
  std::vector<T> some;
  for (std::size_t i = static_cast<std::size_t>(n) - 1; i < all.size();
       i += static_cast<std::size_t>(n))
  {
    some.push_back(all[i]);
  }
  return some;
}

using Trace = std::vector<Contact>;

/// With so many substeps at most, or in so many steps, one after another.
Trace TraceOf(const std::shared_ptr<const TriangleSurface>& surface, const std::vector<Vec3>& hips,
  const Vec3& start, int pieces, int steps, std::vector<double>& times, double radius = 0.0)
{
  using Clock = std::chrono::steady_clock;
  GodObject god({ surface }, radius > 0.0 ? Tip::Ball : Tip::Point);
  god.SetTipRadius(radius);
  if (pieces > 0)
  {
    god.SetSubstepLimit(pieces);
  }
  god.Place(start);
  Vec3 last = start;
  Trace trace;
  for (std::size_t k = 0; k < hips.size(); ++k)
  {
    const auto begin = Clock::now();
    for (int i = 1; i < steps; ++i)
    {
      god.Update(last + (static_cast<double>(i) / steps) * (hips[k] - last));
    }
    trace.push_back(god.Update(hips[k]));
    times[k] =
      std::min(times[k], std::chrono::duration<double, std::micro>(Clock::now() - begin).count());
    last = hips[k];
  }
  return trace;
}

/// What a hand that moves slowly would touch.
struct Slow
{
  Trace Right;
  int Steps = 0;      ///< in which each tick's way was gone
  long Undecided = 0; ///< ticks that still lie elsewhere in half as many
};

/// Each tick's way in 32 steps, 64, ... until two traces agree in all ticks, or 1024.
Slow Converged(const std::shared_ptr<const TriangleSurface>& surface, const std::vector<Vec3>& hips,
  const Vec3& start, double radius = 0.0)
{
  std::vector<double> times(hips.size(), HUGE_VAL);
  Slow slow;
  Trace coarser = TraceOf(surface, hips, start, 1, 32, times, radius);
  for (slow.Steps = 64;; slow.Steps *= 2)
  {
    slow.Right = TraceOf(surface, hips, start, 1, slow.Steps, times, radius);
    slow.Undecided = 0;
    for (std::size_t i = 0; i < hips.size(); ++i)
    {
      slow.Undecided += Length(slow.Right[i].Position - coarser[i].Position) > 0.1 * Apart ? 1 : 0;
    }
    if (slow.Undecided == 0 || slow.Steps == MostSteps)
    {
      return slow;
    }
    coarser = std::move(slow.Right);
  }
}

/// How many ticks of two traces touch, and lie apart.
struct Share
{
  long Contact = 0;
  long Apart = 0;

  void Add(const Trace& trace, const Trace& right)
  {
    for (std::size_t i = 0; i < trace.size(); ++i)
    {
      if (right[i].IsTouching() || trace[i].IsTouching())
      {
        ++this->Contact;
        this->Apart += Length(trace[i].Position - right[i].Position) > ::Apart ? 1 : 0;
      }
    }
  }
  double Percent() const
  {
    return this->Contact > 0 ? 100.0 * static_cast<double>(this->Apart) / this->Contact : 0.0;
  }
};

void Print(const std::string& head, const char* method, double number, const Share& share,
  const std::vector<double>& times)
{
  std::printf("%s,%s,%g,%ld,%.3f", head.c_str(), method, number, share.Contact, share.Percent());
  if (!times.empty())
  {
    std::printf(",%.3f,%.2f,%.2f", Mean(times), Quantile(times, 0.99), Quantile(times, 0.999));
  }
  else
  {
    std::printf(",,,");
  }
  std::printf("\n");
  std::fflush(stdout);
}

std::shared_ptr<const TriangleSurface> WithHalfTheTriangles(
  const std::shared_ptr<const TriangleSurface>& surface)
{
  TriangleMesh mesh;
  for (const Vec3& local : surface->Points())
  {
    mesh.Points.push_back(local + surface->Origin());
  }
  mesh.Triangles = surface->Triangles();
  vtkNew<vtkQuadricDecimation> decimation;
  decimation->SetInputData(ToPolyData(mesh));
  decimation->SetTargetReduction(0.5);
  decimation->Update();
  SurfaceOptions options;
  options.TouchedSide = surface->TouchedSide();
  std::string error;
  std::shared_ptr<const TriangleSurface> coarse =
    TriangleSurface::Build(ToMesh(decimation->GetOutput()), options, error);
  if (!coarse)
  {
    Fail("Half the triangles could not be built: " + error);
  }
  return coarse;
}

/// The HIPs of a stroke, one a millisecond, and a place outside of everything to begin from, so
/// that no ball overlaps there.
struct Hand
{
  std::vector<Vec3> Fine, Hips;
  Vec3 Start;

  Hand(const std::shared_ptr<const TriangleSurface>& surface, bool isAbove, unsigned seed,
    double speed, double depth)
    : Fine(Stroke(surface, isAbove, seed).Make(speed, depth))
    , Hips(EveryNth(this->Fine, Finest))
    , Start(isAbove ? Vec3{ this->Fine[0][0], this->Fine[0][1], 2.0 * InHand }
                    : 2.0 * InHand * Unit(this->Fine[0]))
  {
  }
};

/// How many facets, by their boxes, lie within reach of where each tick begins: the tip's radius
/// and the way that it goes. Whoever certifies that way has to have an answer to each of them.
std::vector<double> FacetsInReach(
  const TriangleSurface& surface, const Trace& trace, const Vec3& start, double radius)
{
  std::vector<std::int32_t> indices(surface.Triangles().size());
  std::vector<double> counts;
  Vec3 from = start;
  for (const Contact& contact : trace)
  {
    TriangleList found{ indices.data(), static_cast<std::int32_t>(indices.size()) };
    surface.Engine().FindInBall(
      from - surface.Origin(), radius + Length(contact.Position - from), found);
    counts.push_back(found.Count);
    from = contact.Position;
  }
  return counts;
}

/// The point and the balls in turns, so that what else the machine does falls on all of them.
void Time(const Options& options, const std::string& name,
  const std::shared_ptr<const TriangleSurface>& surface, double speed, double depth)
{
  std::vector<double> radii{ 0.0 };
  radii.insert(radii.end(), options.Tips.begin(), options.Tips.end());
  std::vector<std::vector<double>> times(radii.size());
  std::vector<std::vector<double>> facets(radii.size());
  for (int i = 0; i < options.Strokes; ++i)
  {
    const Hand hand(
      surface, name == "fault", options.Seed + static_cast<unsigned>(i), speed, depth * 1e-3);
    std::vector<std::vector<double>> least(
      radii.size(), std::vector<double>(hand.Hips.size(), HUGE_VAL));
    std::vector<Trace> traces(radii.size());
    for (int repeat = 0; repeat < TimedRuns; ++repeat)
    {
      for (std::size_t r = 0; r < radii.size(); ++r)
      {
        traces[r] = TraceOf(surface, hand.Hips, hand.Start, 1, 1, least[r], 1e-3 * radii[r]);
      }
    }
    for (std::size_t r = 0; r < radii.size(); ++r)
    {
      const std::vector<double> counts =
        FacetsInReach(*surface, traces[r], hand.Start, 1e-3 * radii[r]);
      for (std::size_t k = 0; k < hand.Hips.size(); ++k)
      {
        if (traces[r][k].IsTouching())
        {
          times[r].push_back(least[r][k]);
          facets[r].push_back(counts[k]);
        }
      }
    }
  }
  for (std::size_t r = 0; r < radii.size(); ++r)
  {
    const double mean = Mean(times[r]);
    const double p99 = Quantile(times[r], 0.99);
    std::printf("%s,%g,%g,%g,%zu,%.3f,%.3f,%.2f,%.2f,%.2f,%.2f,%.1f,%.0f\n", name.c_str(), speed,
      depth, radii[r], times[r].size(), mean, Quantile(times[r], 0.5), p99,
      Quantile(times[r], 0.999), mean / Mean(times[0]), p99 / Quantile(times[0], 0.99),
      Mean(facets[r]), Quantile(facets[r], 0.99));
  }
  std::fflush(stdout);
}

void Measure(const Options& options, const std::string& name,
  const std::shared_ptr<const TriangleSurface>& surface, double speed, double depth)
{
  struct SlowHand : Hand
  {
    using Hand::Hand;
    Slow Once, Often; ///< of Hips, and of Fine
  };
  const std::shared_ptr<const TriangleSurface> coarse =
    options.IsQuick ? nullptr : WithHalfTheTriangles(surface);
  const Vec3 aside{ 0.6, -0.48, 0.64 };
  const std::array<double, 2> moves{ 1e-6, 55e-6 };
  std::vector<SlowHand> hands;
  std::array<Share, 2> moved;
  int steps = 0;
  Share undecided;
  for (int i = 0; i < options.Strokes; ++i)
  {
    SlowHand hand(
      surface, name == "fault", options.Seed + static_cast<unsigned>(i), speed, depth * 1e-3);
    hand.Once = Converged(surface, hand.Hips, hand.Start);
    steps = std::max(steps, hand.Once.Steps);
    undecided.Contact += static_cast<long>(hand.Hips.size());
    undecided.Apart += hand.Once.Undecided;
    if (!options.IsQuick)
    {
      hand.Often = Converged(surface, hand.Fine, hand.Start);
    }
    for (std::size_t k = 0; !options.IsQuick && k < moves.size(); ++k)
    {
      std::vector<Vec3> others = hand.Hips;
      for (Vec3& hip : others)
      {
        hip = hip + moves[k] * aside;
      }
      moved[k].Add(
        Converged(surface, others, hand.Start + moves[k] * aside).Right, hand.Once.Right);
    }
    hands.push_back(std::move(hand));
  }
  char head[200];
  std::snprintf(head, sizeof(head), "%s,%g,%g", name.c_str(), speed, depth);
  Print(head, "converged", steps, undecided, {});
  for (std::size_t k = 0; !options.IsQuick && k < moves.size(); ++k)
  {
    Print(head, "moved", moves[k], moved[k], {});
  }
  if (!options.IsQuick)
  {
    Share halved;
    for (const SlowHand& hand : hands)
    {
      halved.Add(Converged(coarse, hand.Hips, hand.Start).Right, hand.Once.Right);
    }
    Print(head, "detail", 0.5, halved, {});
  }
  const auto run = [&](const char* method, double number, int pieces, int steps, double radius,
                     const std::vector<Trace>& rights)
  {
    Share share;
    std::vector<double> times;
    for (std::size_t h = 0; h < hands.size(); ++h)
    {
      const SlowHand& hand = hands[h];
      std::vector<double> least(hand.Hips.size(), HUGE_VAL);
      Trace trace;
      for (int repeat = 0; repeat < 3; ++repeat)
      {
        trace = TraceOf(surface, hand.Hips, hand.Start, pieces, steps, least, radius);
      }
      share.Add(trace, rights[h]);
      for (std::size_t k = 0; k < least.size(); ++k)
      {
        if (trace[k].IsTouching())
        {
          times.push_back(least[k]);
        }
      }
    }
    Print(head, method, number, share, times);
  };
  std::vector<Trace> rights;
  for (const SlowHand& hand : hands)
  {
    rights.push_back(hand.Once.Right);
  }
  for (const double limit : options.Limits)
  {
    run("substeps", limit, static_cast<int>(limit), 1, 0.0, rights);
  }
  for (const double steps : options.Uniform)
  {
    run("steps", steps, 1, static_cast<int>(steps), 0.0, rights);
  }
  for (const double tip : options.Tips)
  {
    Share left;
    int most = 0;
    std::vector<Trace> own;
    for (const SlowHand& hand : hands)
    {
      Slow slow = Converged(surface, hand.Hips, hand.Start, 1e-3 * tip);
      left.Contact += static_cast<long>(hand.Hips.size());
      left.Apart += slow.Undecided;
      most = std::max(most, slow.Steps);
      own.push_back(std::move(slow.Right));
    }
    char name[40];
    std::snprintf(name, sizeof(name), "tip converged %g", tip);
    Print(head, name, most, left, {});
    std::snprintf(name, sizeof(name), "tip %g", tip);
    for (const int steps : { 1, 4, 16 })
    {
      run(name, steps, 1, steps, 1e-3 * tip, own);
    }
  }
  if (options.IsQuick)
  {
    return;
  }
  const int most =
    static_cast<int>(*std::max_element(options.Limits.begin(), options.Limits.end()));
  for (const int pieces : { 1, most })
  {
    for (const int every : { 8, 4, 2, 1 })
    {
      Share share;
      for (const SlowHand& hand : hands)
      {
        const std::vector<Vec3> hips = EveryNth(hand.Fine, every);
        std::vector<double> least(hips.size(), HUGE_VAL);
        share.Add(EveryNth(TraceOf(surface, hips, hand.Start, pieces, 1, least), 8 / every),
          EveryNth(hand.Often.Right, 8));
      }
      Print(head, pieces == 1 ? "rate in one step" : "rate", 4000.0 / every, share, {});
    }
  }
  if (options.Tips.empty())
  {
    return;
  }
  // The same of a ball.
  std::array<Share, 2> movedBall;
  std::array<Share, 4> rateBall;
  Share halvedBall;
  constexpr std::array<int, 4> everies{ 8, 4, 2, 1 };
  for (const SlowHand& hand : hands)
  {
    const Trace right = Converged(surface, hand.Hips, hand.Start, Ball).Right;
    const Trace often = EveryNth(Converged(surface, hand.Fine, hand.Start, Ball).Right, 8);
    for (std::size_t k = 0; k < moves.size(); ++k)
    {
      std::vector<Vec3> others = hand.Hips;
      for (Vec3& hip : others)
      {
        hip = hip + moves[k] * aside;
      }
      movedBall[k].Add(
        Converged(surface, others, hand.Start + moves[k] * aside, Ball).Right, right);
    }
    for (std::size_t k = 0; k < everies.size(); ++k)
    {
      const std::vector<Vec3> hips = EveryNth(hand.Fine, everies[k]);
      std::vector<double> least(hips.size(), HUGE_VAL);
      rateBall[k].Add(
        EveryNth(TraceOf(surface, hips, hand.Start, 1, 1, least, Ball), 8 / everies[k]), often);
    }
    halvedBall.Add(Converged(coarse, hand.Hips, hand.Start, Ball).Right, right);
  }
  for (std::size_t k = 0; k < moves.size(); ++k)
  {
    Print(head, "ball moved", moves[k], movedBall[k], {});
  }
  for (std::size_t k = 0; k < everies.size(); ++k)
  {
    Print(head, "ball rate", 4000.0 / everies[k], rateBall[k], {});
  }
  Print(head, "ball detail", 0.5, halvedBall, {});
}

TriangleMesh MakeMesh(const Options& options, const std::string& name)
{
  if (name.rfind("sphere", 0) == 0)
  {
    return Icosphere(name.size() > 6 ? std::atoi(name.c_str() + 6) : 5, InHand);
  }
  return ReadSurface(options.Folder, name, InHand);
}
}

int main(int argc, char** argv)
{
  const Options options = Read(argc, argv);
  std::printf("%s\n",
    options.IsTimed ? "surface,speed,depth,tip,contact,mean,median,p99,p99.9,mean ratio,p99 ratio,"
                      "facets,p99 facets"
                    : "surface,speed,depth,method,number,contact,apart,mean,p99,p99.9");
  for (const std::string& name : options.Names)
  {
    TriangleMesh mesh = MakeMesh(options, name);
    if (mesh.Triangles.empty())
    {
      continue; // ReadSurface has said so
    }
    std::string error;
    const std::shared_ptr<const TriangleSurface> surface =
      TriangleSurface::Build(std::move(mesh), SurfaceOptions(), error);
    if (!surface)
    {
      Fail(name + " could not be built: " + error);
    }
    for (const double speed : options.Speeds)
    {
      for (const double depth : options.Depths)
      {
        (options.IsTimed ? Time : Measure)(options, name, surface, speed, depth);
      }
    }
  }
  return 0;
}
