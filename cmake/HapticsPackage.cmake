# The CMake package VTKHaptics, and env.sh in the build folder.
include(CMakePackageConfigHelpers)

set(haptics_package_dir "${CMAKE_BINARY_DIR}/${haptics_cmake_destination}")
configure_file("${CMAKE_CURRENT_LIST_DIR}/VTKHaptics-config.cmake.in"
  "${haptics_package_dir}/VTKHaptics-config.cmake" @ONLY)
write_basic_package_version_file("${haptics_package_dir}/VTKHaptics-config-version.cmake"
  COMPATIBILITY SameMinorVersion)
configure_file("${CMAKE_CURRENT_LIST_DIR}/HapticsFindVTK.cmake"
  "${haptics_package_dir}/HapticsFindVTK.cmake" COPYONLY)
install(
  FILES
    "${haptics_package_dir}/VTKHaptics-config.cmake"
    "${haptics_package_dir}/VTKHaptics-config-version.cmake"
    "${haptics_package_dir}/HapticsFindVTK.cmake"
  DESTINATION "${haptics_cmake_destination}")
install(FILES "${PROJECT_SOURCE_DIR}/LICENSE"
  DESTINATION "${CMAKE_INSTALL_DATAROOTDIR}/doc/vtkhaptics")

configure_file("${CMAKE_CURRENT_LIST_DIR}/env.sh.in" "${CMAKE_BINARY_DIR}/env.sh" @ONLY)
