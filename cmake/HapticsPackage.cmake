# The CMake package VTKHaptics, and env.sh in the build folder.
include(CMakePackageConfigHelpers)

set(haptics_package_dir "${CMAKE_BINARY_DIR}/${haptics_cmake_destination}")
configure_file("${CMAKE_CURRENT_LIST_DIR}/VTKHapticsConfig.cmake.in"
  "${haptics_package_dir}/VTKHapticsConfig.cmake" @ONLY)
write_basic_package_version_file("${haptics_package_dir}/VTKHapticsConfigVersion.cmake"
  COMPATIBILITY SameMinorVersion)
configure_file("${CMAKE_CURRENT_LIST_DIR}/HapticsFindVTK.cmake"
  "${haptics_package_dir}/HapticsFindVTK.cmake" COPYONLY)
install(
  FILES
    "${haptics_package_dir}/VTKHapticsConfig.cmake"
    "${haptics_package_dir}/VTKHapticsConfigVersion.cmake"
    "${haptics_package_dir}/HapticsFindVTK.cmake"
  DESTINATION "${haptics_cmake_destination}")
install(FILES "${PROJECT_SOURCE_DIR}/LICENSE"
  DESTINATION "${CMAKE_INSTALL_DATAROOTDIR}/doc/vtkhaptics")

# env.sh, in the build folder and installed. The prefix may be chosen as late as in
# `cmake --install`, so that the installed one is made there from half-filled text.
set(haptics_env_plugin)
if (HAPTICS_BUILD_PARAVIEW_PLUGIN)
  string(CONCAT haptics_env_plugin "export PV_PLUGIN_PATH=\"$haptics_prefix/"
    "${CMAKE_INSTALL_LIBDIR}/${PARAVIEW_PLUGIN_SUBDIR}/Haptics"
    "\${PV_PLUGIN_PATH:+:$PV_PLUGIN_PATH}\"\n")
endif ()
set(haptics_prefix "${CMAKE_BINARY_DIR}")
set(haptics_env_to_prefix ".")
configure_file("${CMAKE_CURRENT_LIST_DIR}/env.sh.in" "${CMAKE_BINARY_DIR}/env.sh" @ONLY)
set(haptics_prefix "@CMAKE_INSTALL_PREFIX@")
set(haptics_env_to_prefix "../..")
configure_file(
  "${CMAKE_CURRENT_LIST_DIR}/env.sh.in" "${CMAKE_BINARY_DIR}/installed/env.sh.in" @ONLY)
install(CODE "
  configure_file(
    \"${CMAKE_BINARY_DIR}/installed/env.sh.in\" \"${CMAKE_BINARY_DIR}/installed/env.sh\" @ONLY)")
install(FILES "${CMAKE_BINARY_DIR}/installed/env.sh"
  DESTINATION "${CMAKE_INSTALL_DATAROOTDIR}/vtkhaptics")
