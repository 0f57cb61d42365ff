# Functions that add tests.
#
#   haptics_add_gtest(<name> <source>... LIBRARIES <target>... [SERIAL] [FIXTURE <fixture>])
#     A GoogleTest program; ctest shows each of its cases as <name>.<suite>.<case>.
#     SERIAL: nothing else runs at the same time, for tests that measure time. FIXTURE: what has to run
#     before, by the name in that test's FIXTURES_SETUP.
#
#   haptics_add_python_test(<name> <script> [ARGS <arg>...] [PVPYTHON] [SERIAL] [FIXTURE <fixture>])
#     A script run by python3, or by pvpython, that finds the package vtkhaptics and fails with
#     a non-zero exit; with 77 it is skipped. PVPYTHON needs the ParaView build.
#
# C++ image tests use VTK's own vtk_add_test_cxx() and vtk_test_cxx_executable().

set(haptics_test_environment
  "PYTHONPATH=${haptics_python_dir}"
  "PYTHONDONTWRITEBYTECODE=1"
  "HAPTICS_SOURCE_DIR=${PROJECT_SOURCE_DIR}"
  "HAPTICS_TEST_OUTPUT=${_vtk_build_TEST_OUTPUT_DIRECTORY}")

# Sets a variable to the programs and libraries of a folder and those below it.
function (haptics_targets_below result folder)
  get_property(targets DIRECTORY "${folder}" PROPERTY BUILDSYSTEM_TARGETS)
  set(found)
  foreach (target IN LISTS targets)
    get_target_property(type "${target}" TYPE)
    if (NOT type STREQUAL "UTILITY" AND NOT type STREQUAL "INTERFACE_LIBRARY")
      list(APPEND found "${target}")
    endif ()
  endforeach ()
  get_property(subfolders DIRECTORY "${folder}" PROPERTY SUBDIRECTORIES)
  foreach (subfolder IN LISTS subfolders)
    haptics_targets_below(below "${subfolder}")
    list(APPEND found ${below})
  endforeach ()
  set("${result}" "${found}" PARENT_SCOPE)
endfunction ()

function (haptics_add_gtest name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "SERIAL" "FIXTURE" "LIBRARIES")
  set(fixture)
  if (arg_FIXTURE)
    set(fixture FIXTURES_REQUIRED "${arg_FIXTURE}")
  endif ()
  add_executable("${name}" ${arg_UNPARSED_ARGUMENTS})
  target_link_libraries("${name}" PRIVATE ${arg_LIBRARIES} GTest::gtest_main)
  target_compile_options("${name}" PRIVATE -Wall -Wextra)
  # VTK's factories (rendering, for one) register themselves only in programs that ask for it.
  set(vtk_modules ${arg_LIBRARIES})
  list(FILTER vtk_modules INCLUDE REGEX "^VTK::")
  if (vtk_modules)
    vtk_module_autoinit(TARGETS "${name}" MODULES ${vtk_modules})
  endif ()
  gtest_discover_tests("${name}"
    TEST_PREFIX       "${name}."
    DISCOVERY_MODE    PRE_TEST
    WORKING_DIRECTORY "${_vtk_build_TEST_OUTPUT_DIRECTORY}"
    PROPERTIES
      LABELS      "haptics"
      RUN_SERIAL  "${arg_SERIAL}"
      ENVIRONMENT "HAPTICS_SOURCE_DIR=${PROJECT_SOURCE_DIR}"
      ${fixture})
endfunction ()

function (haptics_add_python_test name script)
  cmake_parse_arguments(PARSE_ARGV 2 arg "PVPYTHON;SERIAL" "FIXTURE" "ARGS")
  set(cost 0)
  if (arg_PVPYTHON)
    set(cost 10) # the longest ones begin first, so that none is left alone at the end
    set(interpreter "$<TARGET_FILE:ParaView::pvpython>" --force-offscreen-rendering)
  else ()
    set(interpreter "${Python3_EXECUTABLE}")
  endif ()
  get_filename_component(script "${script}" ABSOLUTE)
  add_test(NAME "${name}"
    COMMAND ${interpreter} "${script}" ${arg_ARGS}
    WORKING_DIRECTORY "${_vtk_build_TEST_OUTPUT_DIRECTORY}")
  set_tests_properties("${name}" PROPERTIES
    LABELS            "haptics"
    RUN_SERIAL        "${arg_SERIAL}"
    SKIP_RETURN_CODE  77
    COST              "${cost}"
    FIXTURES_REQUIRED "${arg_FIXTURE}"
    ENVIRONMENT       "${haptics_test_environment}")
endfunction ()

# Installs into a scratch prefix and moves that, then configures, builds and runs Consumer/ against it
# alone.
function (haptics_add_consumer_test)
  set(prefix "${CMAKE_BINARY_DIR}/Testing/Consumer/install")
  add_test(NAME Consumer.Install
    COMMAND "${CMAKE_COMMAND}" "-DBUILD=${CMAKE_BINARY_DIR}" "-DPREFIX=${prefix}"
            -P "${CMAKE_CURRENT_SOURCE_DIR}/Consumer/TestInstall.cmake")
  add_test(NAME Consumer.InstalledTree
    COMMAND "${Python3_EXECUTABLE}" -B "${CMAKE_CURRENT_SOURCE_DIR}/Consumer/TestInstalledTree.py"
            "${prefix}" "${PROJECT_SOURCE_DIR}" "${CMAKE_BINARY_DIR}"
            "$<BOOL:${HAPTICS_BUILD_PARAVIEW_PLUGIN}>")
  set_tests_properties(Consumer.InstalledTree PROPERTIES
    FIXTURES_REQUIRED haptics_install
    LABELS            "haptics")
  add_test(NAME Consumer.BuildAndRun
    COMMAND "${CMAKE_CTEST_COMMAND}"
      --build-and-test "${CMAKE_CURRENT_SOURCE_DIR}/Consumer"
                       "${CMAKE_BINARY_DIR}/Testing/Consumer/build"
      --build-generator "${CMAKE_GENERATOR}"
      --build-options
        "-DVTKHaptics_ROOT=${prefix}"
        "-DCMAKE_BUILD_TYPE=${CMAKE_BUILD_TYPE}"
        "-DCMAKE_CXX_FLAGS=${CMAKE_CXX_FLAGS}"
        "-DPython3_EXECUTABLE=${Python3_EXECUTABLE}"
      --test-command consumer)
  add_test(NAME Consumer.Neighbours
    COMMAND "${CMAKE_CTEST_COMMAND}"
      --build-and-test "${CMAKE_CURRENT_SOURCE_DIR}/Consumer/Neighbours"
                       "${CMAKE_BINARY_DIR}/Testing/Consumer/neighbours"
      --build-generator "${CMAKE_GENERATOR}"
      --build-options
        "-DVTKHaptics_ROOT=${prefix}"
        "-DCMAKE_BUILD_TYPE=${CMAKE_BUILD_TYPE}"
        "-DCMAKE_CXX_FLAGS=${CMAKE_CXX_FLAGS}"
        "-DPython3_EXECUTABLE=${Python3_EXECUTABLE}"
      --test-command neighbours)
  set_tests_properties(Consumer.Neighbours PROPERTIES
    FIXTURES_REQUIRED haptics_install
    LABELS            "haptics")
  add_test(NAME Consumer.DeviceTemplate
    COMMAND "${CMAKE_CTEST_COMMAND}"
      --build-and-test "${prefix}/${CMAKE_INSTALL_DATAROOTDIR}/vtkhaptics/device"
                       "${CMAKE_BINARY_DIR}/Testing/Consumer/device"
      --build-generator "${CMAKE_GENERATOR}"
      --build-options
        "-DVTKHaptics_ROOT=${prefix}"
        "-DCMAKE_BUILD_TYPE=${CMAKE_BUILD_TYPE}"
        "-DCMAKE_CXX_FLAGS=${CMAKE_CXX_FLAGS} -Wall -Wextra"
        "-DPython3_EXECUTABLE=${Python3_EXECUTABLE}"
      --test-command try_pen)
  set_tests_properties(Consumer.DeviceTemplate PROPERTIES
    FIXTURES_REQUIRED haptics_install
    LABELS            "haptics")
  set_tests_properties(Consumer.Install PROPERTIES FIXTURES_SETUP haptics_install)
  set_tests_properties(Consumer.BuildAndRun PROPERTIES FIXTURES_REQUIRED haptics_install)
  set_tests_properties(Consumer.Install Consumer.BuildAndRun PROPERTIES LABELS "haptics")
  if (haptics_python_destination)
    # From the root folder, without LD_LIBRARY_PATH: only the installed files can answer.
    add_test(NAME Consumer.InstalledPython
      COMMAND "${Python3_EXECUTABLE}" -c
        "import vtkhaptics; print(vtkhaptics.__file__); vtkhaptics.vtkGodObjectFilter()"
      WORKING_DIRECTORY "/")
    set_tests_properties(Consumer.InstalledPython PROPERTIES
      FIXTURES_REQUIRED haptics_install
      LABELS            "haptics"
      ENVIRONMENT       "PYTHONPATH=${prefix}/${haptics_python_destination};LD_LIBRARY_PATH=")
  endif ()
  if (haptics_python_destination AND HAPTICS_BUILD_PARAVIEW_PLUGIN)
    # As a user does it, but for the library path: the installed files find each other without.
    add_test(NAME Consumer.InstalledPlugin
      COMMAND bash -c ". '${prefix}/${CMAKE_INSTALL_DATAROOTDIR}/vtkhaptics/env.sh'; \
LD_LIBRARY_PATH= exec '$<TARGET_FILE:ParaView::pvpython>' --force-offscreen-rendering \
'${CMAKE_CURRENT_SOURCE_DIR}/ParaView/TestInstalledPlugin.py' '${prefix}'"
      WORKING_DIRECTORY "/")
    set_tests_properties(Consumer.InstalledPlugin PROPERTIES
      FIXTURES_REQUIRED haptics_install
      LABELS            "haptics"
      ENVIRONMENT       "PYTHONPATH=;PV_PLUGIN_PATH=")
  endif ()
endfunction ()
