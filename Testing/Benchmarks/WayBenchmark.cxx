// How much of a contact hangs on how often the hand is sampled, and what it costs to mend that.
#include "AnalyticSurfaces.h"
#include "BenchmarkSurfaces.h"
#include "FirstHit.h"
#include "RandomVectors.h"
#include "Statistics.h"

#include <algorithm>
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
                    [--limits N,N...] [--uniform N,N...] [--strokes N] [--seed N]

A HIP strokes a surface as large as in the hand (radius 50 mm) at a steady speed [m/s] and depth
[mm] under its smoothed height, a place a millisecond, 900 places a stroke. Every method touches
along all strokes. A tick is apart where its god-object lies over 1 mm from the converged one: the
same HIP goes its straight way within each tick in 512, 1024, ... up to 4096 steps, until two of these
agree to 1 um.

--surfaces  folder with the real surfaces (default build/surfaces)
--only      names of surfaces (default fault,pial,aneurysm,footbones,t13,gearbox,wing,sphere)
--speeds    default 0.05,0.2,0.5      --depths  default 2,5
--limits    most pieces of the way in a tick (GodObject::SetPieceLimit; default 1,2,4,8,16)
--uniform   as many equal steps in every tick instead (default 4,16)
--strokes   of each surface, speed and depth (default 20)

Prints CSV: surface, speed, depth, method ("pieces" or "steps"), its number, contact ticks, the
share of them that is apart [%], mean, 99th and 99.9th percentile of the time of a tick [us]. Each
tick's time is the least of three runs. Rows "moved": the converged god-object of a hand that is
1 um aside. Rows "rate": the same hand sampled at so many Hz, against the converged one at 4 kHz, for
one piece and for the largest of --limits.
)";

constexpr double Hand = 0.05;      // radius of a surface in the hand [m]
constexpr double Smoothing = 5e-3; // of a surface's height, along the hand's way [m]
constexpr double Apart = 1e-3;     // [m]
constexpr int TicksOfStroke = 900;
constexpr int Finest = 4; // places of the HIP a millisecond

struct Options
{
  std::string Folder = "build/surfaces";
  std::vector<std::string> Names = { "fault", "pial", "aneurysm", "footbones", "t13", "gearbox",
    "wing", "sphere" };
  std::vector<double> Speeds = { 0.05, 0.2, 0.5 };
  std::vector<double> Depths = { 2, 5 };
  std::vector<double> Limits = { 1, 2, 4, 8, 16 };
  std::vector<double> Uniform = { 4, 16 };
  int Strokes = 20;
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
    this->Place = { 0.4 * Hand * this->Outwards[0], 0.4 * Hand * this->Outwards[1], 0.0 };
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
        if (std::abs(this->Place[k] + step * this->Along[k]) > 0.5 * Hand)
        {
          this->Along[k] = -this->Along[k];
        }
        this->Place[k] += step * this->Along[k];
      }
      return;
    }
    this->Along = Unit(this->Along + turn * Cross(this->Outwards, this->Along));
    const Vec3 from = this->Outwards;
    const double angle = step / std::max(this->Smoothed, 0.2 * Hand);
    this->Outwards = Unit(from + angle * this->Along);
    this->Along = Unit(this->Along - angle * from);
  }

  double Height()
  {
    const double far = 2.0 * Hand;
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

/// Every tick's way in 512 steps, 1024, ... until two agree.
Trace Converged(const std::shared_ptr<const TriangleSurface>& surface,
  const std::vector<Vec3>& hips, const Vec3& start)
{
  GodObject before({ surface });
  GodObject trial({ surface });
  before.SetPieceLimit(1);
  trial.SetPieceLimit(1);
  before.Place(start);
  Vec3 last = start;
  Trace trace;
  for (const Vec3& hip : hips)
  {
    Contact contact;
    for (int steps = 512; steps <= 4096; steps *= 2)
    {
      trial.Continue(before);
      const Vec3 coarser = contact.Position;
      for (int i = 1; i <= steps; ++i)
      {
        contact = trial.Update(i == steps ? hip : last + (double(i) / steps) * (hip - last));
      }
      if (steps > 512 && Length(contact.Position - coarser) < 1e-6)
      {
        break;
      }
    }
    before.Continue(trial);
    last = hip;
    trace.push_back(contact);
  }
  return trace;
}

/// With so many pieces at most, or in so many steps, one after another.
Trace Touched(const std::shared_ptr<const TriangleSurface>& surface, const std::vector<Vec3>& hips,
  const Vec3& start, int pieces, int steps, std::vector<double>& times)
{
  using Clock = std::chrono::steady_clock;
  GodObject god({ surface });
  if (pieces > 0)
  {
    god.SetPieceLimit(pieces);
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

void Measure(const Options& options, const std::string& name,
  const std::shared_ptr<const TriangleSurface>& surface, double speed, double depth)
{
  struct Hand
  {
    std::vector<Vec3> Fine, Hips;
    Vec3 Start;
    Trace Right, FineRight; ///< converged, once a millisecond and at every 8th of Fine
  };
  std::vector<Hand> hands;
  Share moved;
  for (int i = 0; i < options.Strokes; ++i)
  {
    Stroke stroke(surface, name == "fault", options.Seed + static_cast<unsigned>(i));
    Hand hand;
    hand.Fine = stroke.Make(speed, depth * 1e-3);
    hand.Hips = EveryNth(hand.Fine, Finest);
    hand.Start = hand.Fine[0];
    hand.Right = Converged(surface, hand.Hips, hand.Start);
    hand.FineRight = EveryNth(Converged(surface, hand.Fine, hand.Start), 8);
    const Vec3 aside{ 0.6e-6, -0.48e-6, 0.64e-6 };
    std::vector<Vec3> others = hand.Hips;
    for (Vec3& hip : others)
    {
      hip = hip + aside;
    }
    moved.Add(Converged(surface, others, hand.Start + aside), hand.Right);
    hands.push_back(std::move(hand));
  }
  char head[200];
  std::snprintf(head, sizeof(head), "%s,%g,%g", name.c_str(), speed, depth);
  Print(head, "moved", 1e-6, moved, {});
  const auto run = [&](const char* method, double number, int pieces, int steps)
  {
    Share share;
    std::vector<double> times;
    for (const Hand& hand : hands)
    {
      std::vector<double> least(hand.Hips.size(), HUGE_VAL);
      Trace trace;
      for (int repeat = 0; repeat < 3; ++repeat)
      {
        trace = Touched(surface, hand.Hips, hand.Start, pieces, steps, least);
      }
      share.Add(trace, hand.Right);
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
  for (const double limit : options.Limits)
  {
    run("pieces", limit, static_cast<int>(limit), 1);
  }
  for (const double steps : options.Uniform)
  {
    run("steps", steps, 1, static_cast<int>(steps));
  }
  const int most =
    static_cast<int>(*std::max_element(options.Limits.begin(), options.Limits.end()));
  for (const int pieces : { 1, most })
  {
    for (const int every : { 8, 4, 2, 1 })
    {
      Share share;
      for (const Hand& hand : hands)
      {
        const std::vector<Vec3> hips = EveryNth(hand.Fine, every);
        std::vector<double> least(hips.size(), HUGE_VAL);
        share.Add(EveryNth(Touched(surface, hips, hand.Start, pieces, 1, least), 8 / every),
          hand.FineRight);
      }
      Print(head, pieces == 1 ? "rate, one piece" : "rate", 4000.0 / every, share, {});
    }
  }
}

TriangleMesh MakeMesh(const Options& options, const std::string& name)
{
  if (name == "sphere")
  {
    return Icosphere(5, Hand);
  }
  return ReadSurface(options.Folder, name, Hand);
}
}

int main(int argc, char** argv)
{
  const Options options = Read(argc, argv);
  std::printf("surface,speed,depth,method,number,contact,apart,mean,p99,p99.9\n");
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
        Measure(options, name, surface, speed, depth);
      }
    }
  }
  return 0;
}
