#include "vtkHapticSettings.h"

#include "vtkObjectFactory.h"

vtkStandardNewMacro(vtkHapticSettings);

void vtkHapticSettings::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Device: " << this->Device << "\n";
  os << indent << "Stiffness: " << this->Stiffness << "\n";
  os << indent << "MaximumForce: " << this->MaximumForce << "\n";
  os << indent << "Side: " << this->Side << "\n";
  os << indent << "ShowForce: " << this->ShowForce << "\n";
  os << indent << "ShowReadout: " << this->ShowReadout << "\n";
  os << indent << "ShowTrail: " << this->ShowTrail << "\n";
  os << indent << "ShowHand: " << this->ShowHand << "\n";
  os << indent << "HandSize: " << this->HandSize << "\n";
}
