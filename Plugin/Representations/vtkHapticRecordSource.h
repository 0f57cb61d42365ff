/**
 * @class   vtkHapticRecordSource
 * @brief   Landmarks or a trace as a source of the pipeline: polydata kept as text
 *
 * A scene lives on the client, a pipeline's sources on the server. This source carries what the
 * hand has left (vtkHapticScene::GetTrace(), vtkHapticLandmarks::GetOutput()) as the text of one
 * property: it goes to the server, into state files and into Python traces as any other.
 *
 * Where the server has several processes the first one has it all.
 *
 * Errors: contents that are no polydata give an empty output and an error.
 *
 * GUI thread.
 *
 * @sa vtkPVHapticScene
 */
#ifndef Haptics_vtkHapticRecordSource_h
#define Haptics_vtkHapticRecordSource_h

#include "vtkHapticsRepresentationsModule.h"
#include "vtkPolyDataAlgorithm.h"

#include <string>

class VTKHAPTICSREPRESENTATIONS_EXPORT vtkHapticRecordSource : public vtkPolyDataAlgorithm
{
public:
  static vtkHapticRecordSource* New();
  vtkTypeMacro(vtkHapticRecordSource, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /** A .vtp file's text, as MakeContents() makes it. Empty by default, for an empty output. */
  void SetContents(const char* contents);
  const char* GetContents() { return this->Contents.c_str(); }
  ///@}

  /**
   * What SetContents() takes to give this polydata; null gives the empty text. Where it has a point
   * array Force it has one ForceMagnitude [N] as well, which charts and colours can go by.
   */
  static std::string MakeContents(vtkPolyData* record);

  /**
   * Of a trace (vtkHapticScene::GetTrace()) the parts in contact from the point `first` on, as
   * curves on the surface: one polyline for each contact, with the trace's point arrays and
   * arc_length [world unit] from its start. Ticks that moved by less than 1/2000 of the diagonal of
   * all of them are left out; a contact that did not move gives no curve.
   */
  static void MakeCurves(vtkPolyData* trace, vtkIdType first, vtkPolyData* curves);

protected:
  vtkHapticRecordSource();
  ~vtkHapticRecordSource() override;

  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

private:
  vtkHapticRecordSource(const vtkHapticRecordSource&) = delete;
  void operator=(const vtkHapticRecordSource&) = delete;

  std::string Contents;
};

#endif
