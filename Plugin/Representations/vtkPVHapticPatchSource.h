/**
 * @class   vtkPVHapticPatchSource
 * @brief   gives of a surface on the ranks of a ParaView server what is near the hand
 *
 * On the client, behind a vtkHapticSurfaceRepresentation. What belongs to the whole surface is
 * asked for once for each version of the data, patches as the hand goes on. Each question goes
 * through ParaView's session to all ranks and back, while the caller waits: one way to the server
 * and back, what the ranks need to crop, and the bytes of the patch.
 *
 * Where the server does not answer, that is an error, and the output stays what it was: the hand is
 * held at the rim of the patch that is known.
 *
 * @sa vtkHapticSurfaceRepresentation vtkHapticPatchInformation
 */
#ifndef Haptics_vtkPVHapticPatchSource_h
#define Haptics_vtkPVHapticPatchSource_h

#include "vtkHapticPatchAlgorithm.h"
#include "vtkHapticsRepresentationsModule.h"

#ifndef __VTK_WRAP__
#include <functional>
#endif

class vtkHapticPatchInformation;

class VTKHAPTICSREPRESENTATIONS_EXPORT vtkPVHapticPatchSource : public vtkHapticPatchAlgorithm
{
public:
  static vtkPVHapticPatchSource* New();
  vtkTypeMacro(vtkPVHapticPatchSource, vtkHapticPatchAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /** The array of the box of all points in the field data of an answer: two corners. */
  static constexpr const char* BoxName = "HapticWholeBox";

#ifndef __VTK_WRAP__
  /** C++ only: puts a question to all ranks; it has no head after that where none answers. */
  using Gather = std::function<void(vtkHapticPatchInformation*)>;
  void SetGather(Gather gather);
#endif
  /** The data on the server may have changed. */
  void SetOutdated();
  /** Whether the server gives this surface in patches; it is asked where that may have changed. */
  bool IsInPatches();

  bool Survey() override;

  ///@{
  /** Since it was made: patches that came, their bytes, and how long the last took [s]. */
  vtkGetMacro(NumberOfPatches, vtkTypeInt64);
  vtkGetMacro(NumberOfBytes, vtkTypeInt64);
  vtkGetMacro(AnswerTime, double);
  ///@}

protected:
  vtkPVHapticPatchSource();
  ~vtkPVHapticPatchSource() override;

#ifndef __VTK_WRAP__
  bool Crop(const haptics::PatchRegion& region, Use use,
    std::vector<vtkSmartPointer<vtkPolyData>>& parts) override;
  bool CropNearest(
    const haptics::Vec3& place, std::vector<vtkSmartPointer<vtkPolyData>>& parts) override;
#endif

private:
  vtkPVHapticPatchSource(const vtkPVHapticPatchSource&) = delete;
  void operator=(const vtkPVHapticPatchSource&) = delete;

  bool Ask(vtkHapticPatchInformation* question);
  bool AskOfThisVersion(vtkHapticPatchInformation* question);

#ifndef __VTK_WRAP__
  Gather Server;
#endif
  bool IsOutdated = true;
  bool Patches = false;
  bool IsSilent = false; // the server has not answered, which was reported
  vtkTypeUInt64 ServerVersion = 0;
  ///@{
  /// The last of which there was a patch for the hand: the server's number for it, and
  /// GetVersion().
  vtkTypeUInt64 TouchedServerVersion = 0;
  vtkTypeUInt64 TouchedVersion = 0;
  ///@}
  vtkTypeInt64 NumberOfPatches = 0;
  vtkTypeInt64 NumberOfBytes = 0;
  double AnswerTime = 0.0;
};

#endif
