// Lets bodies in hands go over surfaces while everything around them changes at random, with the
// safety at its defaults: other surfaces come and go, cells are made anew, points move, actors are
// dragged, hidden and emptied, materials and the workspace change, the clutch is pressed. Asks in
// every tick whether the force is allowed, and whether the god-object is outside of the ball that
// stands still; after each round, whether the hand rests; and where nothing that changes does any
// work, whether the hand has got none. Prints the seed of what goes wrong, and exits with 1.
//
//     HapticsChangeSoak                  about two minutes
//     HapticsChangeSoak --minutes 60     for long
//     HapticsChangeSoak --seed 17        one round again
#include "vtkActor.h"
#include "vtkCallbackCommand.h"
#include "vtkCommand.h"
#include "vtkCubeSource.h"
#include "vtkDataArray.h"
#include "vtkHapticProperties.h"
#include "vtkHapticSafety.h"
#include "vtkHapticScene.h"
#include "vtkHapticServo.h"
#include "vtkMath.h"
#include "vtkNew.h"
#include "vtkPlaneSource.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkPolyDataMapper.h"
#include "vtkSimulatedHapticDevice.h"
#include "vtkSphereSource.h"
#include "vtkTrivialProducer.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <random>
#include <string>
#include <thread>

namespace
{
constexpr double Radius = 0.03; // of the ball that stands still [m]
constexpr double Period = 0.001;

/// Growth of a force beyond the line from zero to the one before.
double Growth(const double before[3], const double after[3])
{
  const double squared = vtkMath::Dot(before, before);
  const double share =
    squared > 0.0 ? std::clamp(vtkMath::Dot(after, before) / squared, 0.0, 1.0) : 0.0;
  const double change[3] = { after[0] - share * before[0], after[1] - share * before[1],
    after[2] - share * before[2] };
  return vtkMath::Norm(change);
}

vtkSmartPointer<vtkPolyData> Ball(double radius, int resolution)
{
  vtkNew<vtkSphereSource> ball;
  ball->SetRadius(radius);
  ball->SetThetaResolution(resolution);
  ball->SetPhiResolution(resolution);
  ball->Update();
  return ball->GetOutput();
}

/// A sheet below the ball, that waves where `phase` is not 0.
vtkSmartPointer<vtkPolyData> Sheet(int resolution, double phase)
{
  vtkNew<vtkPlaneSource> plane;
  plane->SetOrigin(-0.1, -0.1, -0.05);
  plane->SetPoint1(0.1, -0.1, -0.05);
  plane->SetPoint2(-0.1, 0.1, -0.05);
  plane->SetResolution(resolution, 20);
  plane->Update();
  vtkPoints* points = plane->GetOutput()->GetPoints();
  for (vtkIdType i = 0; phase != 0.0 && i < points->GetNumberOfPoints(); ++i)
  {
    double p[3];
    points->GetPoint(i, p);
    p[2] += 0.003 * std::sin(40.0 * p[0] + phase);
    points->SetPoint(i, p);
  }
  return plane->GetOutput();
}

class Round
{
public:
  Round(unsigned seed, bool isLive)
    : Seed(seed)
    , IsLive(isLive)
    , Random(seed)
  {
    // Of what changes half of the rounds have only what does no work.
    this->DoesWork = this->Random() % 2 == 0;
    this->Device->SetPreset(static_cast<int>(seed % 4));
    this->Device->SetHandStiffness(this->Uniform(50.0, 400.0));
    this->Device->SetHandDamping(this->Uniform(0.5, 3.0));
    this->Scene->SetDevice(this->Device);
    this->Scene->SetStiffness(this->Uniform(200.0, 1500.0));
    this->Scene->AddSurface(Ball(Radius, 40));
    this->BallCells->SetOutput(Ball(0.02, 20));
    this->Mapper->SetInputConnection(this->BallCells->GetOutputPort());
    this->Actor->SetMapper(this->Mapper);
    this->Actor->SetPosition(0.06, 0.0, 0.0);
    this->Scene->AddSurface(this->Actor);
    this->SheetCells->SetOutput(Sheet(20, 0.0));
    this->SheetId = this->Scene->AddSurface(this->SheetCells->GetOutputPort());
    this->Scene->StartRecording();
  }

  bool Run()
  {
    const auto errors = [](vtkObject*, unsigned long, void*, void*) {};
    vtkNew<vtkCallbackCommand> quiet; // an actor that jumps is reported, and is no fault here
    quiet->SetCallback(errors);
    this->Scene->AddObserver(vtkCommand::ErrorEvent, quiet);
    this->Device->SetPosition(0.0, 0.0, 0.05);
    if (this->IsLive)
    {
      this->Check(this->Scene->Engage(), "engages");
    }
    this->Go(20);
    for (int stroke = 0; stroke < 12; ++stroke)
    {
      this->Aim();
      this->Go(this->IsLive ? 15 : 25, true);
    }
    this->Scene->SetClutched(false);
    this->Scene->GetServo()->SetPaused(false);
    this->Scene->ResetWorkspace();
    this->To[0] = 0.003;
    this->To[1] = 0.002;
    this->To[2] = 0.022; // in the ball's top
    this->Go(120);       // 1.9 s, nothing changes
    this->Judge();
    return this->Good;
  }

private:
  double Uniform(double from, double to)
  {
    return std::uniform_real_distribution<double>(from, to)(this->Random);
  }
  void Check(bool isGood, const char* what, double value = 0.0)
  {
    if (!isGood)
    {
      std::printf("seed %u%s: %s (%g)\n", this->Seed, this->IsLive ? ", live" : "", what, value);
      this->Good = false;
    }
  }

  /// A target on or in something, at up to 0.3 m/s.
  void Aim()
  {
    const double heights[] = { 0.025, 0.02, 0.01, 0.0, -0.055, -0.053 };
    this->To[0] = this->Uniform(-0.03, 0.08);
    this->To[1] = this->Uniform(-0.03, 0.03);
    this->To[2] = heights[this->Random() % 6];
  }

  /// So many updates of 16 ticks.
  void Go(int updates, bool changes = false)
  {
    for (int update = 0; update < updates; ++update)
    {
      if (changes)
      {
        this->ChangeSomething();
      }
      for (int tick = 0; tick < 16; ++tick)
      {
        double way[3];
        vtkMath::Subtract(this->To, this->At, way);
        const double length = vtkMath::Norm(way);
        const double step = std::min(length, 0.3 * Period);
        for (int i = 0; length > 0.0 && i < 3; ++i)
        {
          this->At[i] += step * way[i] / length;
        }
        this->Device->SetPosition(this->At[0], this->At[1], this->At[2]);
        if (!this->IsLive)
        {
          this->Scene->Step(1);
        }
        else if (tick == 0)
        {
          std::this_thread::sleep_for(std::chrono::milliseconds(10));
          this->Scene->Update();
        }
      }
    }
  }

  void ChangeSomething()
  {
    switch (this->Random() % (this->DoesWork ? 12 : 3))
    {
      case 0: // elsewhere
        if (this->Elsewhere < 0)
        {
          vtkNew<vtkCubeSource> cube;
          cube->SetCenter(2.0, 0.0, 0.0);
          cube->Update();
          this->Elsewhere = this->Scene->AddSurface(cube->GetOutput());
        }
        else
        {
          this->Scene->RemoveSurface(this->Elsewhere);
          this->Elsewhere = -1;
        }
        break;
      case 1: // other cells in the same place
        this->SheetCells->SetOutput(Sheet(20 + static_cast<int>(this->Random() % 3), 0.0));
        break;
      case 2:
        break;
      case 3: // scaled about the god-object, and back
        this->Scene->ScaleWorkspace(this->IsLarge ? 0.8 : 1.25);
        this->IsLarge = !this->IsLarge;
        break;
      case 4:
        this->SheetCells->SetOutput(Sheet(20, this->Uniform(0.0, 6.0)));
        break;
      case 5:
        this->Actor->AddPosition(
          this->Uniform(-0.004, 0.004), this->Uniform(-0.004, 0.004), this->Uniform(-0.004, 0.004));
        break;
      case 6:
        this->Actor->SetVisibility(this->Random() % 2);
        break;
      case 7:
        if (this->Random() % 2)
        {
          this->BallCells->SetOutput(vtkNew<vtkPolyData>());
        }
        else
        {
          this->BallCells->SetOutput(Ball(this->Uniform(0.015, 0.022), 18));
        }
        break;
      case 8:
        this->Scene->GetSurfaceProperties(this->SheetId)
          ->SetStiffness(this->Uniform(100.0, 1000.0));
        this->Scene->GetSurfaceProperties(this->SheetId)
          ->SetDynamicFriction(this->Uniform(0.0, 0.6));
        break;
      case 9:
        this->Scene->SetClutched(this->Random() % 3 == 0);
        break;
      case 10:
        this->Random() % 2 ? this->Scene->ResetWorkspace()
                           : this->Scene->SetStiffness(this->Uniform(200.0, 1500.0));
        break;
      default:
        this->Scene->GetServo()->SetPaused(this->Random() % 3 == 0);
        break;
    }
  }

  void Judge()
  {
    vtkPolyData* trace = this->Scene->GetTrace();
    const vtkIdType ticks = trace->GetNumberOfPoints();
    vtkPointData* data = trace->GetPointData();
    vtkDataArray* forces = data->GetArray("Force");
    vtkDataArray* hips = data->GetArray("HapticInterfacePoint");
    vtkDataArray* stiffness = data->GetArray("Stiffness");
    vtkDataArray* times = data->GetArray("Time");
    Ticks += ticks;
    Resting += vtkMath::Norm(this->Scene->GetForce()) > 0.0 ? 1 : 0;
    this->Check(ticks > 500, "ticks", static_cast<double>(ticks));
    const double largest = this->Scene->GetServo()->GetEffectiveMaximumForce();
    const double slew = this->Scene->GetServo()->GetSafety()->GetSlewLimit();
    double work = 0.0;
    double allowed = 1e-6;
    for (vtkIdType i = 1; i < ticks && this->Good; ++i)
    {
      double before[3];
      double force[3];
      double from[3];
      double hip[3];
      double god[3];
      forces->GetTuple(i - 1, before);
      forces->GetTuple(i, force);
      hips->GetTuple(i - 1, from);
      hips->GetTuple(i, hip);
      trace->GetPoint(i, god);
      this->Check(vtkMath::Norm(force) <= largest * (1.0 + 1e-9), "largest force", i);
      const double period = this->IsLive
        ? std::min(times->GetTuple1(i) - times->GetTuple1(i - 1), 2.0 * Period)
        : Period;
      this->Check(Growth(before, force) <= slew * period * (1.0 + 1e-6), "slew limit", i);
      // Facets lie up to 0.7 % inside the ball.
      this->Check(vtkMath::Norm(god) > 0.99 * Radius, "inside the ball at tick", i);
      double step[3];
      vtkMath::Subtract(hip, from, step);
      for (int axis = 0; axis < 3; ++axis)
      {
        work += 0.5 * (before[axis] + force[axis]) * step[axis];
      }
      // A surface is met and left in the middle of a tick's step.
      const bool wasIn = vtkMath::Norm(before) > 0.0;
      const bool isIn = vtkMath::Norm(force) > 0.0;
      Touching += isIn ? 1 : 0;
      allowed += wasIn != isIn
        ? 0.25 * stiffness->GetTuple1(isIn ? i : i - 1) * vtkMath::Dot(step, step)
        : 0.0;
    }
    this->Check(
      this->DoesWork || this->IsLive || work <= allowed, "work that nobody did [J]", work);
    double mean[3] = {};
    double deviation = 0.0;
    const vtkIdType last = std::min<vtkIdType>(200, ticks);
    for (int pass = 0; pass < 2; ++pass)
    {
      for (vtkIdType i = ticks - last; i < ticks; ++i)
      {
        double hip[3];
        hips->GetTuple(i, hip);
        for (int axis = 0; axis < 3; ++axis)
        {
          mean[axis] += pass == 0 ? hip[axis] / static_cast<double>(last) : 0.0;
          deviation += pass == 1 ? std::pow(hip[axis] - mean[axis], 2) : 0.0;
        }
      }
    }
    deviation = std::sqrt(deviation / static_cast<double>(last));
    Worst = std::max(Worst, deviation);
    this->Check(deviation < (this->IsLive ? 2e-4 : 1e-6), "does not rest [m]", deviation);
  }

public:
  static double Worst; ///< deviation at rest [m]
  static vtkIdType Ticks;
  static vtkIdType Touching; ///< of them, with a force
  static int Resting;        ///< rounds that ended pressed on something

private:
  unsigned Seed;
  bool IsLive;
  std::mt19937 Random;
  bool DoesWork = false;
  bool Good = true;
  bool IsLarge = false;
  int Elsewhere = -1;
  int SheetId = -1;
  double At[3] = { 0.0, 0.0, 0.05 };
  double To[3] = { 0.0, 0.0, 0.05 };
  vtkNew<vtkSimulatedHapticDevice> Device;
  vtkNew<vtkHapticScene> Scene;
  vtkNew<vtkTrivialProducer> BallCells;
  vtkNew<vtkPolyDataMapper> Mapper;
  vtkNew<vtkActor> Actor;
  vtkNew<vtkTrivialProducer> SheetCells;
};

double Round::Worst = 0.0;
vtkIdType Round::Ticks = 0;
vtkIdType Round::Touching = 0;
int Round::Resting = 0;
}

int main(int argc, char** argv)
{
  double minutes = 2.0;
  long only = -1;
  for (int i = 1; i < argc; ++i)
  {
    if (std::strcmp(argv[i], "--minutes") == 0 && i + 1 < argc)
    {
      minutes = std::atof(argv[++i]);
    }
    else if (std::strcmp(argv[i], "--seed") == 0 && i + 1 < argc)
    {
      only = std::atol(argv[++i]);
    }
    else
    {
      std::printf("usage: %s [--minutes 2] [--seed N]\n", argv[0]);
      return std::strcmp(argv[i], "--help") == 0 ? 0 : 2;
    }
  }
  const auto begin = std::chrono::steady_clock::now();
  const auto passed = [&]
  { return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count(); };
  int rounds = 0;
  int bad = 0;
  for (unsigned seed = only < 0 ? 1 : static_cast<unsigned>(only); passed() < 60.0 * minutes;
       ++seed)
  {
    const bool isLive = seed % 10 == 0;
    bad += Round(seed, isLive).Run() ? 0 : 1;
    ++rounds;
    if (only >= 0 || bad >= 20)
    {
      break;
    }
  }
  std::printf(
    "%d rounds in %.0f s, %d bad; %lld ticks, %lld with a force; %d rounds ended pressed on "
    "something, largest deviation at rest %.1e m\n",
    rounds, passed(), bad, static_cast<long long>(Round::Ticks),
    static_cast<long long>(Round::Touching), Round::Resting, Round::Worst);
  return bad > 0 ? 1 : 0;
}
