# Type stubs (.pyi) of the compiled Python modules, made next to them where VTK brings its generator:
# Debian's VTK 9.1 does not.
#
#   haptics_add_python_stubs(<folder of the package> <install destination>)
function (haptics_add_python_stubs folder destination)
  execute_process(
    COMMAND "${Python3_EXECUTABLE}" -c "import vtkmodules.generate_pyi"
    RESULT_VARIABLE missing
    OUTPUT_QUIET ERROR_QUIET)
  if (missing)
    message(STATUS "No type stubs: this VTK has no vtkmodules.generate_pyi.")
    file(WRITE "${folder}/__init__.pyi" "from typing import Any\n\ndef __getattr__(name: str) -> Any: ...\n")
    install(FILES "${folder}/__init__.pyi" DESTINATION "${destination}")
    return ()
  endif ()
  set(modules vtkHapticsFilters vtkHapticsDevices vtkHapticsScene vtkHapticsView)
  set(targets ${modules})
  list(TRANSFORM targets APPEND "Python")
  set(stubs ${modules})
  list(TRANSFORM stubs REPLACE "(.+)" "${folder}/\\1.pyi")
  list(APPEND stubs "${folder}/__init__.pyi")
  set(maker "${CMAKE_CURRENT_SOURCE_DIR}/cmake/python_stubs.py")
  cmake_path(GET folder PARENT_PATH path)
  add_custom_command(
    OUTPUT  ${stubs}
    COMMAND "${CMAKE_COMMAND}" -E env "PYTHONPATH=${path}" "PYTHONDONTWRITEBYTECODE=1"
            "${Python3_EXECUTABLE}" "${maker}" "${folder}" ${modules}
    DEPENDS ${targets} "${maker}"
    COMMENT "Writing Python type stubs"
    VERBATIM)
  add_custom_target(HapticsPythonStubs ALL DEPENDS ${stubs})
  install(FILES ${stubs} DESTINATION "${destination}")
  # Where VTK has stubs of its own there are none here.
  cmake_path(GET destination PARENT_PATH packages)
  install(DIRECTORY "${path}/vtkmodules-stubs" DESTINATION "${packages}" OPTIONAL)
endfunction ()
