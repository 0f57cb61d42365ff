# A Haply Inverse3 through its maker's service: WebSocket by Boost.Beast, JSON by JsonCpp.
find_package(Boost 1.74 QUIET)
pkg_check_modules(JSONCPP QUIET IMPORTED_TARGET jsoncpp)
option(HAPTICS_DEVICE_HAPLY "Build the driver of the Haply Inverse3 (Boost, JsonCpp)" ON)
if (HAPTICS_DEVICE_HAPLY AND Boost_FOUND AND JSONCPP_FOUND)
  list(APPEND haptics_optional_classes Haply/vtkHaplyHapticDevice)
  list(APPEND haptics_optional_sources
    Haply/HaplyDriver.cxx
    Haply/HaplyMessage.cxx
    Haply/HaplySocket.cxx)
  list(APPEND haptics_optional_rooms Haply)
  list(APPEND haptics_optional_libraries
    $<BUILD_INTERFACE:Boost::headers>
    $<BUILD_INTERFACE:PkgConfig::JSONCPP>)
elseif (HAPTICS_DEVICE_HAPLY)
  message(STATUS "The driver of the Haply Inverse3 is left out: it needs Boost and JsonCpp "
    "(Debian: libboost-dev, libjsoncpp-dev)")
endif ()
