/**
 * @class   vtkHapticPatchSource
 * @brief   gives of a surface that does not fit in memory what is near the hand
 *
 * The surface comes in pieces, one in memory at a time, from any producer of vtkPolyData that can
 * give them by VTK's UPDATE_PIECE_NUMBER, or of a vtkPartitionedDataSet of vtkPolyData, whose
 * partitions are one piece then. vtkXMLPPolyDataReader (.pvtp) and vtkXMLPolyDataReader of a file
 * with several pieces read only what they are asked for. So does vtkHDFReader, which reads polydata
 * since VTK 9.3; that of VTK 9.7 keeps all that it has read, unless its UseCache is off. Others
 * give correct results but hold all of it.
 *
 * The first patch needs two passes over all pieces, which read each and keep of it a box and the
 * edges on its seams (class haptics::SurfaceCensus). They are made again when the producer has been
 * modified. Then only those pieces are read that the region meets; PiecesInMemory of them stay.
 *
 * Points of different pieces are one point where their coordinates are equal. The default merge
 * tolerance of vtkGodObjectFilter, 0, is what makes a patch equal to the whole.
 *
 * Errors: no producer, one whose output is not polydata, a piece that cannot be read or touched
 * (its number is named), no cell in any piece. Then the output stays what it was, of the region
 * before; it is empty where there was none.
 *
 * All methods are for one thread.
 *
 * @sa vtkHapticPatchAlgorithm vtkGodObjectTrace
 */
#ifndef Haptics_vtkHapticPatchSource_h
#define Haptics_vtkHapticPatchSource_h

#include "vtkHapticPatchAlgorithm.h"
#include "vtkHapticsFiltersModule.h"

#include <memory> // for std::unique_ptr
#include <string> // for std::string

class vtkAlgorithmOutput;

class VTKHAPTICSFILTERS_EXPORT vtkHapticPatchSource : public vtkHapticPatchAlgorithm
{
public:
  static vtkHapticPatchSource* New();
  vtkTypeMacro(vtkHapticPatchSource, vtkHapticPatchAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /** What gives the pieces; null, the default, is an error of Update(). */
  void SetSurfaceConnection(vtkAlgorithmOutput* pieces);
  ///@{
  /**
   * In how many pieces the surface is read: as many as the file has, or fewer, which then are read
   * several at a time (of vtkHDFReader not next to each other, which takes memory). Default 1; at
   * least 1, other values are clamped.
   */
  vtkSetClampMacro(NumberOfPieces, int, 1, VTK_INT_MAX);
  vtkGetMacro(NumberOfPieces, int);
  ///@}
  ///@{
  /** How many pieces stay in memory, those last used. Default 4; at least 1, clamped. */
  void SetPiecesInMemory(int pieces);
  int GetPiecesInMemory() const;
  ///@}

  ///@{
  /**
   * Whether a scene that builds in the background (vtkHapticSurfaces::SetBackgroundBuilding()) has
   * pieces read on a thread of this source, so that its Update() does not wait for a file. Then the
   * producer and what is before it are for this source alone and may be changed only after
   * FinishReading(). They and their observers run on that thread, so that none may be written in
   * Python. Default off.
   */
  vtkSetMacro(ReadInBackground, bool);
  vtkGetMacro(ReadInBackground, bool);
  vtkBooleanMacro(ReadInBackground, bool);
  ///@}
  /** Whether pieces are being read in the background. */
  bool IsReading() const;
  /** Waits for that. */
  void FinishReading();

  /**
   * Makes both passes now, where they are to be made. False and an error where that fails.
   */
  bool Survey() override;
  /** How often a piece was read, by passes and for patches. */
  vtkIdType GetNumberOfReads();

  vtkMTimeType GetMTime() override;

#ifndef __VTK_WRAP__
  bool GetsInBackground() const override
  {
    return this->ReadInBackground;
  }
  bool Fetch(const haptics::PatchRegion& region) override;
#endif

protected:
  vtkHapticPatchSource();
  ~vtkHapticPatchSource() override;

#ifndef __VTK_WRAP__
  bool Crop(const haptics::PatchRegion& region, Use use,
    std::vector<vtkSmartPointer<vtkPolyData>>& parts) override;
  bool CropNearest(
    const haptics::Vec3& place, std::vector<vtkSmartPointer<vtkPolyData>>& parts) override;
#endif

private:
  vtkHapticPatchSource(const vtkHapticPatchSource&) = delete;
  void operator=(const vtkHapticPatchSource&) = delete;

  bool Report(bool isDone, const std::string& error);

  class Internals;
  std::unique_ptr<Internals> Internal;
  int NumberOfPieces = 1;
  bool ReadInBackground = false;
};

#endif
