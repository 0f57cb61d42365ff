# A 3Dconnexion SpaceMouse through spacenavd. Only the header of libspnav is used here: the library is
# loaded when a SpaceMouse is asked for.
pkg_check_modules(SPNAV QUIET IMPORTED_TARGET spnav>=1.0)
option(HAPTICS_DEVICE_SPACEMOUSE "Build the driver of the 3Dconnexion SpaceMouse (libspnav)" ON)
if (HAPTICS_DEVICE_SPACEMOUSE AND SPNAV_FOUND)
  list(APPEND haptics_optional_classes SpaceMouse/vtkSpaceMouseHapticDevice)
  list(APPEND haptics_optional_sources
    SpaceMouse/SpaceMouseDriver.cxx
    SpaceMouse/SpnavLibrary.cxx)
  list(APPEND haptics_optional_rooms SpaceMouse)
  list(APPEND haptics_optional_include_folders ${SPNAV_INCLUDE_DIRS})
elseif (HAPTICS_DEVICE_SPACEMOUSE)
  message(STATUS
    "The driver of the SpaceMouse is left out: it needs libspnav 1.0 (Debian: libspnav-dev)")
endif ()
