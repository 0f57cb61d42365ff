# What is installed besides modules and plugin: the CMake package VTKHaptics, env.sh, documents and
# examples; and the target that removes all again.
include(CMakePackageConfigHelpers)

set(haptics_package_dir "${CMAKE_BINARY_DIR}/${haptics_cmake_destination}")
# Links of this build's own (haptics_find_vtk()) are nobody else's: who uses the package makes his.
set(haptics_vtk_dir "${VTK_DIR}")
string(FIND "${VTK_DIR}" "${CMAKE_BINARY_DIR}/" haptics_at)
if (haptics_at EQUAL 0)
  set(haptics_vtk_dir)
endif ()
configure_file("${CMAKE_CURRENT_LIST_DIR}/VTKHapticsConfig.cmake.in"
  "${haptics_package_dir}/VTKHapticsConfig.cmake" @ONLY)
write_basic_package_version_file("${haptics_package_dir}/VTKHapticsConfigVersion.cmake"
  COMPATIBILITY SameMajorVersion)
configure_file("${CMAKE_CURRENT_LIST_DIR}/HapticsFindVTK.cmake"
  "${haptics_package_dir}/HapticsFindVTK.cmake" COPYONLY)
install(
  FILES
    "${haptics_package_dir}/VTKHapticsConfig.cmake"
    "${haptics_package_dir}/VTKHapticsConfigVersion.cmake"
    "${haptics_package_dir}/HapticsFindVTK.cmake"
  DESTINATION "${haptics_cmake_destination}")
# The documents lie as in the sources, so that their links lead somewhere.
set(haptics_doc_destination "${CMAKE_INSTALL_DATAROOTDIR}/doc/vtkhaptics")
install(FILES "${PROJECT_SOURCE_DIR}/LICENSE" "${PROJECT_SOURCE_DIR}/CITATION.cff"
  DESTINATION "${haptics_doc_destination}")
file(GLOB haptics_documents RELATIVE "${PROJECT_SOURCE_DIR}" CONFIGURE_DEPENDS
  "${PROJECT_SOURCE_DIR}/*.md"
  "${PROJECT_SOURCE_DIR}/*/README.md"
  "${PROJECT_SOURCE_DIR}/*/*/README.md"
  "${PROJECT_SOURCE_DIR}/Data/images/*.*"
  "${PROJECT_SOURCE_DIR}/Testing/Benchmarks/results/*.png"
  "${PROJECT_SOURCE_DIR}/Testing/Consumer/CMakeLists.txt"
  "${PROJECT_SOURCE_DIR}/Testing/Consumer/*.cxx"
  "${PROJECT_SOURCE_DIR}/Interactors/Python/examples/*.*"
  "${PROJECT_SOURCE_DIR}/Plugin/docs/*.*"
  "${PROJECT_SOURCE_DIR}/Plugin/Qt/*.png"
  "${PROJECT_SOURCE_DIR}/Plugin/examples/*.*"
  "${PROJECT_SOURCE_DIR}/packaging/*.md")
foreach (document IN LISTS haptics_documents)
  cmake_path(GET document PARENT_PATH folder)
  install(FILES "${PROJECT_SOURCE_DIR}/${document}"
    DESTINATION "${haptics_doc_destination}/${folder}")
endforeach ()

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

# Not where another project includes this one and has such a target.
if (NOT TARGET uninstall)
  add_custom_target(uninstall
    COMMAND "${CMAKE_COMMAND}" -P "${CMAKE_CURRENT_LIST_DIR}/Uninstall.cmake"
    WORKING_DIRECTORY "${CMAKE_BINARY_DIR}")
endif ()
