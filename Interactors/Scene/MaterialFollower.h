#ifndef Haptics_MaterialFollower_h
#define Haptics_MaterialFollower_h

#include "haptics/Material/SurfaceProperties.h"
#include "haptics/Surface/TriangleSurface.h"
#include "vtkGodObjectFilter.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include <memory>

namespace haptics
{
/// @brief The material of a surface, made anew where its data, its snapshot or the settings of its
/// filter have changed. GUI thread.
class MaterialFollower
{
public:
  using Properties = std::shared_ptr<const SurfaceProperties>;

  /// `data`: the geometry in force, see SurfacePreparation::Fill(); `snapshot`: made of it.
  void Follow(vtkGodObjectFilter* filter, vtkPolyData* data,
    const std::shared_ptr<const TriangleSurface>& snapshot)
  {
    const vtkMTimeType changed = filter->GetMTime();
    if (this->Data != data || this->Snapshot != snapshot || this->Settings != changed)
    {
      this->Current = filter->MakeProperties(data, snapshot);
      this->Data = data;
      this->Snapshot = snapshot;
      this->Settings = changed;
    }
  }
  /// Null where it is plain.
  const Properties& Get() const { return this->Current; }

private:
  Properties Current;
  vtkSmartPointer<vtkPolyData> Data;
  std::shared_ptr<const TriangleSurface> Snapshot;
  vtkMTimeType Settings = 0;
};
}

#endif
