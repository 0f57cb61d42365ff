# `cmake --build build --target HapticsPythonDocumentation` writes the pages of the Python package to
# build/html/python, with a gallery that the examples make. Needs Sphinx; a warning is an error.
if (haptics_python_destination)
  execute_process(
    COMMAND "${Python3_EXECUTABLE}" -c "import sphinx"
    RESULT_VARIABLE haptics_no_sphinx
    OUTPUT_QUIET ERROR_QUIET)
  if (NOT haptics_no_sphinx)
    set(haptics_pages "${PROJECT_BINARY_DIR}/pages")
    add_custom_target(HapticsPythonDocumentation
      COMMAND "${CMAKE_COMMAND}" -E copy_directory
              "${PROJECT_SOURCE_DIR}/Interactors/Python/docs" "${haptics_pages}"
      COMMAND "${CMAKE_COMMAND}" -E env "PYTHONPATH=${haptics_python_dir}"
              "${Python3_EXECUTABLE}" "${haptics_pages}/gallery.py"
              "${PROJECT_SOURCE_DIR}/Interactors/Python/examples" "${haptics_pages}"
      COMMAND "${CMAKE_COMMAND}" -E env "PYTHONPATH=${haptics_python_dir}"
              "${Python3_EXECUTABLE}" -m sphinx -q -W --keep-going -b html
              "${haptics_pages}" "${PROJECT_BINARY_DIR}/html/python"
      COMMENT "Writing the pages of the Python package to ${PROJECT_BINARY_DIR}/html/python"
      VERBATIM)
  endif ()
endif ()
