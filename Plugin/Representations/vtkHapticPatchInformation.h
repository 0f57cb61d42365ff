/**
 * @class   vtkHapticPatchInformation
 * @brief   What a client asks the ranks of a server of a surface that it touches in patches
 *
 * Gathered from a vtkHapticSurfaceRepresentation by vtkSMProxy::GatherInformation(): ParaView
 * brings the question to all ranks, each answers for its own part of the surface, and the answers
 * come back through the ranks to the client. Either what belongs to the whole surface, or what is
 * in a region of it.
 *
 * GUI thread; on the server the thread that serves the client.
 *
 * @sa vtkHapticSurfaceRepresentation vtkPVHapticPatchSource
 */
#ifndef Haptics_vtkHapticPatchInformation_h
#define Haptics_vtkHapticPatchInformation_h

#include "vtkHapticsRepresentationsModule.h"
#include "vtkPVInformation.h"
#include "vtkSmartPointer.h"
#include "vtkType.h"

#include <map>
#include <string>
#include <vector>

class vtkPolyData;

namespace haptics
{
struct PatchRegion;
}

class VTKHAPTICSREPRESENTATIONS_EXPORT vtkHapticPatchInformation : public vtkPVInformation
{
public:
  static vtkHapticPatchInformation* New();
  vtkTypeMacro(vtkHapticPatchInformation, vtkPVInformation);
  void PrintSelf(ostream& os, vtkIndent indent) override;

#ifndef __VTK_WRAP__
  ///@{
  /**
   * C++ only: what is asked for: all in a region, to look at it or, where the hand will be on it,
   * to deform on from there; or the triangles among which is the nearest to its line's start. By
   * default what belongs to the whole.
   */
  enum class Question
  {
    Whole,
    Region,
    TouchedRegion,
    Nearest
  };
  void Ask(Question question, const haptics::PatchRegion& region);
  Question GetQuestion() const
  {
    return static_cast<Question>(static_cast<int>(this->Numbers[7]));
  }
  haptics::PatchRegion GetRegion() const;
  ///@}

  ///@{
  /** C++ only, in each process: its part of the answer; one without cells and field data is left
   * out.
   */
  void SetPart(vtkPolyData* part);
  /** The parts of all processes, in their order. */
  std::vector<vtkSmartPointer<vtkPolyData>> GetParts() const;
  ///@}
#endif

  ///@{
  /**
   * The answer of the first process: whether there is one, whether the surface comes in patches at
   * all, which of its versions this is, and why it cannot be touched; empty where it can.
   */
  void SetHead(bool isInPatches, vtkTypeUInt64 version, const std::string& error);
  bool GetHasHead() const
  {
    return this->HasHead;
  }
  bool GetIsInPatches() const
  {
    return this->IsInPatches;
  }
  vtkTypeUInt64 GetVersion() const
  {
    return this->Version;
  }
  const std::string& GetError() const
  {
    return this->Error;
  }
  ///@}
  void ClearAnswer();
  /** How many bytes the parts have. */
  vtkTypeInt64 GetNumberOfBytes() const;

  void CopyFromObject(vtkObject* representation) override;
  void AddInformation(vtkPVInformation* other) override;
  void CopyToStream(vtkClientServerStream* stream) override;
  void CopyFromStream(const vtkClientServerStream* stream) override;
  void CopyParametersToStream(vtkMultiProcessStream& stream) override;
  void CopyParametersFromStream(vtkMultiProcessStream& stream) override;

protected:
  vtkHapticPatchInformation();
  ~vtkHapticPatchInformation() override;

private:
  vtkHapticPatchInformation(const vtkHapticPatchInformation&) = delete;
  void operator=(const vtkHapticPatchInformation&) = delete;

  // Of the region, its radius the seventh; then the question.
  double Numbers[8] = { 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0 };
  bool HasHead = false;
  bool IsInPatches = false;
  vtkTypeUInt64 Version = 0;
  std::string Error;
  std::map<int, std::string> Parts; // by process
};

#endif
