#include "haptics/Scene/SurfaceSource.h"

namespace haptics
{
SurfaceSource::~SurfaceSource() = default;

PortSource::PortSource(vtkAlgorithmOutput* port)
  : Producer(port->GetProducer())
  , Port(port)
{
}

PortSource::~PortSource() = default;

vtkAlgorithmOutput* PortSource::Geometry(std::string&)
{
  return this->Port;
}

MapperSource::~MapperSource() = default;

vtkAlgorithmOutput* MapperSource::GeometryOf(vtkMapper* mapper, std::string& error)
{
  vtkAlgorithmOutput* const geometry = mapper ? mapper->GetInputConnection(0, 0) : nullptr;
  if (!geometry)
  {
    error = mapper ? "the actor's mapper has no input; give it some"
                   : "the actor has no mapper; give it one";
    return nullptr;
  }
  vtkAlgorithmOutput* const kept = this->Clipped->Follow(mapper, geometry, this->Matrix());
  this->IsClipped = kept != nullptr;
  return kept ? kept : geometry;
}

ActorSource::ActorSource(vtkActor* actor)
  : Prop(actor)
{
}

ActorSource::~ActorSource() = default;

vtkAlgorithmOutput* ActorSource::Geometry(std::string& error)
{
  return this->GeometryOf(this->Prop->GetMapper(), error);
}

Matrix4 ActorSource::Matrix()
{
  Matrix4 matrix;
  this->Prop->GetMatrix(matrix.data());
  return matrix;
}

bool ActorSource::IsShown()
{
  return this->Prop->GetVisibility() && this->Prop->GetPickable();
}

PartSource::~PartSource() = default;

vtkAlgorithmOutput* PartSource::Geometry(std::string& error)
{
  return this->GeometryOf(this->Mapper, error);
}
}
