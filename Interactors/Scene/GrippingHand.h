#ifndef Haptics_GrippingHand_h
#define Haptics_GrippingHand_h

#include "haptics/Tick/TickRecord.h"

namespace haptics
{
class SurfaceSet;

/// @brief What a vtkHapticGrip needs of the scene whose hand grips. GUI thread.
class GrippingHand
{
public:
  virtual ~GrippingHand() = default;

  virtual SurfaceSet& Surfaces() = 0;
  /// Makes the surfaces as they are now those that the servo touches.
  virtual void PullSurfaces() = 0;
  /// The latest tick that the scene has taken in; null before the first.
  virtual const TickRecord* LatestTick() = 0;
  /// The id of the surface that is touched, else -1.
  virtual int TouchedSurface() = 0;
  /// Whether the servo runs, in virtual time too, with the clutch off.
  virtual bool IsThere() = 0;
  ///@{
  /// Has it reported as an event of the scene: which surface is carried from now on, or no more.
  virtual void HasTaken(int surface) = 0;
  virtual void HasLetGo(int surface) = 0;
  ///@}
};
}

#endif
