#ifndef Haptics_SurfaceSource_h
#define Haptics_SurfaceSource_h

#include "haptics/Scene/ActorMatrix.h"
#include "haptics/Scene/ClippedGeometry.h"
#include "vtkActor.h"
#include "vtkAlgorithm.h"
#include "vtkAlgorithmOutput.h"
#include "vtkIdTypeArray.h"
#include "vtkMapper.h"
#include "vtkNew.h"
#include "vtkSmartPointer.h"

#include <string>

namespace haptics
{
/// @brief What a surface of a scene follows: its geometry, its place and whether it is shown.
///
/// All that a scene needs of what a view draws. An actor is asked by its virtual methods alone, so
/// that a scene links no rendering library. GUI thread.
class SurfaceSource
{
public:
  virtual ~SurfaceSource();
  /// Null where there is none, with an `error` that says what to do.
  virtual vtkAlgorithmOutput* Geometry(std::string& error) = 0;
  /// For each cell of the geometry, up to date, the one that was given; null where it is the same.
  virtual vtkIdTypeArray* Cells() const { return nullptr; }
  /// From the geometry's frame to the world.
  virtual Matrix4 Matrix() { return IdentityMatrix; }
  /// Whether the matrix may change.
  virtual bool Moves() const { return false; }
  /// Whether it is visible and pickable.
  virtual bool IsShown() { return true; }
  /// The actor that was given as this surface; null for any other source.
  virtual vtkActor* Actor() const { return nullptr; }
};

/// An output port: geometry in the world frame.
class PortSource : public SurfaceSource
{
public:
  explicit PortSource(vtkAlgorithmOutput* port);
  ~PortSource() override;
  vtkAlgorithmOutput* Geometry(std::string& error) override;

private:
  vtkSmartPointer<vtkAlgorithm> Producer; // an output port does not keep its algorithm alive
  vtkSmartPointer<vtkAlgorithmOutput> Port;
};

/// What a mapper draws: its input, without what its clipping planes cut away.
class MapperSource : public SurfaceSource
{
public:
  ~MapperSource() override;
  vtkIdTypeArray* Cells() const override
  {
    return this->IsClipped ? this->Clipped->Cells() : nullptr;
  }

protected:
  vtkAlgorithmOutput* GeometryOf(vtkMapper* mapper, std::string& error);

private:
  vtkNew<ClippedGeometry> Clipped;
  bool IsClipped = false;
};

/// An actor that hangs in no assembly.
class ActorSource : public MapperSource
{
public:
  explicit ActorSource(vtkActor* actor);
  ~ActorSource() override;
  vtkAlgorithmOutput* Geometry(std::string& error) override;
  Matrix4 Matrix() override;
  bool Moves() const override { return true; }
  bool IsShown() override;
  vtkActor* Actor() const override { return this->Prop; }

private:
  vtkSmartPointer<vtkActor> Prop;
};

/// A place in an assembly, as the assembly says.
class PartSource : public MapperSource
{
public:
  ~PartSource() override;
  vtkAlgorithmOutput* Geometry(std::string& error) override;
  Matrix4 Matrix() override { return this->World; }
  bool Moves() const override { return true; }
  bool IsShown() override { return this->Shown; }

  vtkSmartPointer<vtkMapper> Mapper;
  Matrix4 World = IdentityMatrix;
  bool Shown = true;
};
}

#endif
