#include "haptics/Scene/SurfaceSource.h"

namespace haptics
{
namespace
{
vtkAlgorithmOutput* GeometryOf(vtkMapper* mapper, std::string& error)
{
  vtkAlgorithmOutput* geometry = mapper ? mapper->GetInputConnection(0, 0) : nullptr;
  if (!geometry)
  {
    error = mapper ? "the actor's mapper has no input; give it some"
                   : "the actor has no mapper; give it one";
  }
  return geometry;
}
}

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

ActorSource::ActorSource(vtkActor* actor)
  : Drawn(actor)
{
}

ActorSource::~ActorSource() = default;

vtkAlgorithmOutput* ActorSource::Geometry(std::string& error)
{
  return GeometryOf(this->Drawn->GetMapper(), error);
}

Matrix4 ActorSource::Matrix()
{
  Matrix4 matrix;
  this->Drawn->GetMatrix(matrix.data());
  return matrix;
}

bool ActorSource::IsShown()
{
  return this->Drawn->GetVisibility() && this->Drawn->GetPickable();
}

PartSource::~PartSource() = default;

vtkAlgorithmOutput* PartSource::Geometry(std::string& error)
{
  return GeometryOf(this->Mapper, error);
}
}
