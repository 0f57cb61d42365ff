// A program whose own headers are called as some of ours, with all of ours.
#include "Material.h"
#include "Vec3.h"
#include "all_headers.h"

#include <vtkHapticScene.h>

int main()
{
  const Vec3 own{ 1.0f, 2.0f, 3.0f };
  const haptics::Vec3 ours{ 1.0, 2.0, 3.0 };
  const Material paint{ own.Z };
  const haptics::Material plain;
  haptics::GodObject god({}); // free space
  god.Update(ours);
  return plain.IsPlain && paint.Shininess == god.Update(ours).Position[2] ? 0 : 1;
}
