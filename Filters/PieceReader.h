#ifndef Haptics_PieceReader_h
#define Haptics_PieceReader_h

#include "haptics/Filters/PatchCropper.h"
#include "haptics/Filters/SurfaceCensus.h"
#include "haptics/Surface/SurfacePatch.h"

#include "vtkSmartPointer.h"
#include "vtkType.h"

#include <list>
#include <string>
#include <vector>

class vtkAlgorithm;
class vtkAlgorithmOutput;
class vtkPolyData;

namespace haptics
{
/// @brief Reads the pieces of a surface from a pipeline, and crops them; those last used stay.
///
/// One thread at a time; the pipeline is used on that.
class PieceReader
{
public:
  using Parts = std::vector<vtkSmartPointer<vtkPolyData>>;

  int NumberOfPieces = 1; ///< as they are read
  int PiecesInMemory = 4;
  /// Of each piece; Crop() and CropNearest() need them.
  std::vector<PartBox> Boxes;
  std::vector<PartOffset> Offsets;

  /// From where it reads from now on; false where that is so already. Null: from nowhere, and
  /// nothing may be read.
  bool Connect(vtkAlgorithmOutput* port);
  bool IsConnected() const { return this->Port != nullptr; }
  /// When the pipeline was modified, but by reading from it.
  vtkMTimeType ProducerTime();
  /// Null, and what is wrong in `error`, where it cannot be read.
  vtkPolyData* Read(int piece, std::string& error);
  void ForgetPieces() { this->Kept.clear(); }
  /// How often a piece was read.
  vtkIdType NumberOfReads() const { return this->Reads; }

  /// The pieces that a region meets.
  std::vector<int> PiecesNear(const PatchRegion& region) const;
  /// Whether these are in memory.
  bool Has(const std::vector<int>& pieces) const;
  ///@{
  /// See vtkHapticPatchAlgorithm. False, and what is wrong in `error`, where a piece cannot be
  /// read.
  bool Crop(const PatchRegion& region, Parts& parts, std::string& error);
  bool CropNearest(const Vec3& place, Parts& parts, std::string& error);
  ///@}

private:
  struct KeptPiece
  {
    int Number;
    vtkSmartPointer<vtkPolyData> Data;
  };

  vtkMTimeType PipelineTime() const;
  bool UpdatePiece(int piece);

  vtkSmartPointer<vtkAlgorithm> Producer; // an output port does not keep its algorithm alive
  vtkSmartPointer<vtkAlgorithmOutput> Port;
  std::list<KeptPiece> Kept; ///< the last used first
  vtkIdType Reads = 0;
  vtkMTimeType ModifiedAt = 0;
  vtkMTimeType ReadAt = 0;
};
}

#endif
