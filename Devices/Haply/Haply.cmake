# A Haply Inverse3 through its maker's service: WebSocket by Boost.Beast, JSON by nlohmann's. Both are
# headers only, so that the driver links with the strings of every VTK, pip's old ones too.
find_package(Boost 1.74 QUIET)
find_package(nlohmann_json 3.9 QUIET)
option(HAPTICS_DEVICE_HAPLY "Build the driver of the Haply Inverse3 (Boost, nlohmann_json)" ON)
if (HAPTICS_DEVICE_HAPLY AND Boost_FOUND AND nlohmann_json_FOUND)
  list(APPEND haptics_optional_classes Haply/vtkHaplyHapticDevice)
  list(APPEND haptics_optional_sources
    Haply/HaplyDriver.cxx
    Haply/HaplyMessage.cxx
    Haply/HaplySocket.cxx)
  list(APPEND haptics_optional_rooms Haply)
  list(APPEND haptics_optional_libraries
    $<BUILD_INTERFACE:Boost::headers>
    $<BUILD_INTERFACE:nlohmann_json::nlohmann_json>)
elseif (HAPTICS_DEVICE_HAPLY)
  message(STATUS "The driver of the Haply Inverse3 is left out: it needs Boost and nlohmann_json "
    "(Debian: libboost-dev, nlohmann-json3-dev)")
endif ()
