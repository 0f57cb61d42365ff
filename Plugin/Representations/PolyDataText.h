#ifndef Haptics_PolyDataText_h
#define Haptics_PolyDataText_h

#include <string>

class vtkPolyData;

namespace haptics
{
/// Polydata as the text of a .vtp file, which a property holds: it goes to a server, into states,
/// traces and undo as any other. Names of arrays may be any; arrays without one are left
/// out.
std::string ToText(vtkPolyData* data);

/// Makes polydata of such a text, also of one that was cut or changed: false, without a message and
/// with empty polydata, where it is none.
bool FromText(const std::string& text, vtkPolyData* data);
}

#endif
