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

if (HAPTICS_BUILD_PARAVIEW_PLUGIN)
  set(haptics_plugin_dir "${CMAKE_LIBRARY_OUTPUT_DIRECTORY}/${PARAVIEW_PLUGIN_SUBDIR}/Haptics")
endif ()
configure_file("${CMAKE_CURRENT_LIST_DIR}/env.sh.in" "${CMAKE_BINARY_DIR}/env.sh" @ONLY)

# The same for what is installed, whose prefix may be chosen as late as in `cmake --install`.
set(haptics_installed_plugin)
if (HAPTICS_BUILD_PARAVIEW_PLUGIN)
  set(haptics_installed_plugin "\${CMAKE_LIBRARY_OUTPUT_DIRECTORY}/${PARAVIEW_PLUGIN_SUBDIR}/Haptics")
endif ()
install(CODE "
  set(CMAKE_RUNTIME_OUTPUT_DIRECTORY \"\${CMAKE_INSTALL_PREFIX}/${CMAKE_INSTALL_BINDIR}\")
  set(CMAKE_LIBRARY_OUTPUT_DIRECTORY \"\${CMAKE_INSTALL_PREFIX}/${CMAKE_INSTALL_LIBDIR}\")
  set(haptics_python_dir \"\${CMAKE_INSTALL_PREFIX}/${haptics_python_destination}\")
  set(haptics_plugin_dir \"${haptics_installed_plugin}\")
  configure_file(
    \"${CMAKE_CURRENT_LIST_DIR}/env.sh.in\" \"${CMAKE_BINARY_DIR}/installed/env.sh\" @ONLY)")
install(FILES "${CMAKE_BINARY_DIR}/installed/env.sh"
  DESTINATION "${CMAKE_INSTALL_DATAROOTDIR}/vtkhaptics")
