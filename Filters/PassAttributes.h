#ifndef Haptics_PassAttributes_h
#define Haptics_PassAttributes_h

#include "vtkType.h"

class vtkDataSetAttributes;
class vtkIdTypeArray;

namespace haptics
{
/// Gives `to` the attributes of `from`, tuple `ids[i]` becoming tuple i. Returns how many arrays
/// were left out, having too few tuples for their elements.
int PassAttributes(
  vtkDataSetAttributes* from, vtkIdType elements, vtkIdTypeArray* ids, vtkDataSetAttributes* to);
}

#endif
