#ifndef Pen_h
#define Pen_h

#include <array>
#include <atomic>

/// Stands for the maker's library, so that this project runs: a weight of 100 g on a guide along z,
/// that falls until something holds it. Put your own in its place.
class Pen
{
public:
  /// False where there is none, or it may not be opened.
  bool Connect() { return true; }
  void Disconnect() { this->SetForce({}); }

  /// Where the tip is [m]; false where it does not answer. Called a thousand times a second.
  bool GetPosition(double time, std::array<double, 3>& position)
  {
    const double step = time > this->Time && time < this->Time + 0.1 ? time - this->Time : 0.0;
    this->Time = time;
    this->Speed += step * (this->Force.load() / Mass - Gravity - Friction / Mass * this->Speed);
    this->Height += step * this->Speed;
    position = { 0.0, 0.0, this->Height };
    return true;
  }
  /// What its motors pull [N]. Any thread.
  void SetForce(const std::array<double, 3>& force) { this->Force.store(force[2]); }

private:
  static constexpr double Mass = 0.1;     // [kg]
  static constexpr double Gravity = 9.81; // [m/s^2]
  static constexpr double Friction = 1.0; // [N s/m]

  double Time = 0.0;                // [s]
  double Height = 0.02;             // [m]
  double Speed = 0.0;               // [m/s]
  std::atomic<double> Force{ 0.0 }; // [N]
};

#endif
