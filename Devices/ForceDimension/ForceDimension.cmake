# Force Dimension's devices through their SDK, which is loaded at run time: nothing of it is needed
# here.
option(HAPTICS_DEVICE_FORCEDIMENSION "Build the driver of Force Dimension's devices" ON)
if (HAPTICS_DEVICE_FORCEDIMENSION)
  list(APPEND haptics_optional_classes ForceDimension/vtkForceDimensionHapticDevice)
  list(APPEND haptics_optional_sources
    ForceDimension/DhdLibrary.cxx
    ForceDimension/ForceDimensionDriver.cxx)
  list(APPEND haptics_optional_rooms ForceDimension)
endif ()
