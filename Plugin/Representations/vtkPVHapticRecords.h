/**
 * @class   vtkPVHapticRecords
 * @brief   What a hand leaves in ParaView: recording, trace, landmarks
 *
 * GUI thread.
 *
 * @sa vtkHapticServo vtkHapticTraceRecorder vtkHapticLandmarks vtkPVHapticScene
 */
#ifndef Haptics_vtkPVHapticRecords_h
#define Haptics_vtkPVHapticRecords_h

#include "vtkPVHapticPart.h"

#include <string>
#include <vector>

class VTKHAPTICSREPRESENTATIONS_EXPORT vtkPVHapticRecords : public vtkPVHapticPart
{
public:
  static vtkPVHapticRecords* New();
  vtkTypeMacro(vtkPVHapticRecords, vtkPVHapticPart);

  /** The file that the next run records to, see vtkHapticServo; empty (the default) for none. */
  void SetRecordingFileName(const char* name);
  ///@{
  /**
   * Whether a trace is kept of every tick, with the arrays that the surfaces have when it is turned
   * on. Default off; turning it on forgets the last one.
   */
  void SetRecordTrace(bool record);
  bool GetRecordTrace();
  ///@}

  ///@{
  /** Landmarks: one where the hand touches, an error in free space; the last one away; all away. */
  void DropLandmark();
  void RemoveLastLandmark();
  void ClearLandmarks();
  int GetNumberOfLandmarks();
  int GetNumberOfFreeLandmarks();
  ///@}
  ///@{
  /**
   * All landmarks as a text, for state files and undo. One that is set takes their place, but those
   * at its beginning that are there already stay. Where any of it is no landmark, because it was
   * cut or changed, all stay as they were, and an error says which.
   */
  void SetLandmarkContents(const char* contents);
  std::string GetLandmarkContents();
  ///@}
  /** That error for a text; empty where it is good. */
  static std::string GetProblemOf(const char* contents);
  /**
   * The distance to the one before that is written next to each, a
   * vtkHapticLandmarks::DistanceType. Default straight.
   */
  void SetLandmarkDistance(int distance);

protected:
  vtkPVHapticRecords();
  ~vtkPVHapticRecords() override;

private:
  vtkPVHapticRecords(const vtkPVHapticRecords&) = delete;
  void operator=(const vtkPVHapticRecords&) = delete;

  const std::vector<std::string>& Texts();

  std::vector<std::string> LandmarkTexts; // one each
  vtkMTimeType TextsTime = 0;             // when the landmarks were as there
};

#endif
