#ifndef InPieces_h
#define InPieces_h

#include "vtkAlgorithm.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkStreamingDemandDrivenPipeline.h"

/// A source that gives what it is asked for piece by piece, as a reader of a large file does.
template <class Algorithm>
class InPieces : public Algorithm
{
protected:
  InPieces() { this->SetNumberOfInputPorts(0); }
  int RequestInformation(
    vtkInformation*, vtkInformationVector**, vtkInformationVector* out) override
  {
    out->GetInformationObject(0)->Set(vtkAlgorithm::CAN_HANDLE_PIECE_REQUEST(), 1);
    return 1;
  }
  static int PieceOf(vtkInformationVector* out)
  {
    return out->GetInformationObject(0)->Get(
      vtkStreamingDemandDrivenPipeline::UPDATE_PIECE_NUMBER());
  }
};

#endif
