# 3D Systems' devices through OpenHaptics, which is loaded at run time: nothing of it is needed here.
option(HAPTICS_DEVICE_OPENHAPTICS "Build the driver of 3D Systems' Touch and Phantom" ON)
if (HAPTICS_DEVICE_OPENHAPTICS)
  list(APPEND haptics_optional_classes OpenHaptics/vtkOpenHapticsDevice)
  list(APPEND haptics_optional_sources
    OpenHaptics/HdLibrary.cxx
    OpenHaptics/OpenHapticsDriver.cxx)
  list(APPEND haptics_optional_rooms OpenHaptics)
endif ()
