#ifndef HapticSurface_h
#define HapticSurface_h

#include "TriangleSurface.h"
#include "vtkActor.h"
#include "vtkNew.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkType.h"

#include <array>
#include <memory>
#include <string>
#include <vector>

class vtkAlgorithm;
class vtkAlgorithmOutput;
class vtkGodObjectFilter;
class vtkMatrix4x4;
class vtkObject;

namespace haptics
{
/// @brief One surface of a vtkHapticScene: where it comes from and the snapshot in force.
///
/// The geometry goes through a vtkGodObjectFilter of its own, the actor's matrix is applied to
/// what the filter built: so an actor that moves costs a new engine, but no second clean-up. GUI
/// thread.
class HapticSurface
{
public:
  using Snapshot = std::shared_ptr<const TriangleSurface>;
  using CellIds = std::shared_ptr<const std::vector<vtkIdType>>;

  /// A surface that follows its actor: geometry, matrix, visibility, pickability.
  HapticSurface(int id, vtkActor* actor);
  /// A surface in the world frame that follows a pipeline.
  HapticSurface(int id, vtkAlgorithmOutput* geometry);
  ~HapticSurface();

  int Id() const { return this->Identifier; }
  vtkActor* Actor() const { return this->Source; }
  vtkGodObjectFilter* Filter() const { return this->Preparation; }

  /// Takes in what has changed since the last call. True where another snapshot is in force now
  /// than before, or the surface was shown or hidden. Where the new geometry is no good, `error`
  /// tells why, once for each change, and the snapshot in force stays.
  bool Pull(std::string& error);

  /// What is touched; null while the surface is hidden or was never any good.
  Snapshot Touched() const { return this->Shown ? this->InForce : nullptr; }
  /// The geometry in force, its triangles in the snapshot's order, with its arrays as they were at
  /// the last Pull(); not moved by the actor's matrix. Null where it was never any good.
  vtkPolyData* Prepared() const { return this->Kept; }
  /// For each triangle of the snapshot in force the id of its cell in the geometry given.
  CellIds OriginalCellIds() const { return this->Ids; }

private:
  /// Everything that a snapshot depends on, to see whether it has changed.
  struct Version
  {
    vtkAlgorithmOutput* Geometry = nullptr;
    vtkMTimeType Pipeline = 0;
    std::array<double, 16> Matrix{};

    bool operator==(const Version& other) const
    {
      return this->Geometry == other.Geometry && this->Pipeline == other.Pipeline &&
        this->Matrix == other.Matrix;
    }
  };

  void ListenToErrors();
  bool Connect(std::string& error);
  Version Current();
  bool Build(std::string& error);
  Snapshot Transform(const Snapshot& local, std::string& error) const;
  void KeepCellIds();
  void KeepPrepared();
  static void KeepError(vtkObject* caller, unsigned long event, void* clientData, void* text);

  int Identifier;
  vtkSmartPointer<vtkActor> Source;
  vtkSmartPointer<vtkAlgorithm> Producer; // an output port does not keep its algorithm alive
  vtkSmartPointer<vtkAlgorithmOutput> Geometry;
  vtkNew<vtkGodObjectFilter> Preparation;
  vtkNew<vtkMatrix4x4> Matrix;
  bool Shown = true;
  bool Tried = false;
  Version LastTried;
  std::string LastConnectError;
  std::string PreparationError;
  Snapshot InForce;
  Snapshot Untransformed; ///< what InForce was made of
  std::array<double, 16> MatrixInForce{};
  CellIds Ids;
  vtkSmartPointer<vtkPolyData> Kept;
};
}

#endif
