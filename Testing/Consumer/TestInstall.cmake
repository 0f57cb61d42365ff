# Installs, removes, installs again and moves: what is left at PREFIX was built for another place.
function (run)
  execute_process(COMMAND ${ARGV} RESULT_VARIABLE result)
  if (result)
    message(FATAL_ERROR "failed: ${ARGV}")
  endif ()
endfunction ()

set(first "${PREFIX}-first")
file(REMOVE_RECURSE "${first}" "${PREFIX}")
run("${CMAKE_COMMAND}" --install "${BUILD}" --prefix "${first}")
foreach (file IN ITEMS
    share/doc/vtkhaptics/README.md
    share/doc/vtkhaptics/Data/images/demo.png
    share/doc/vtkhaptics/Interactors/README.md
    share/doc/vtkhaptics/Interactors/Python/examples/offline_trace.py
    share/doc/vtkhaptics/Plugin/Qt/panel.png
    share/doc/vtkhaptics/Plugin/docs/touch.html
    share/doc/vtkhaptics/Plugin/docs/touch.png
    share/doc/vtkhaptics/Plugin/examples/touch_contour.py
    share/doc/vtkhaptics/Testing/Consumer/CMakeLists.txt)
  if (NOT EXISTS "${first}/${file}")
    message(FATAL_ERROR "not installed: ${file}")
  endif ()
endforeach ()
file(GLOB loose "${first}/include/*")
if (NOT loose STREQUAL "${first}/include/vtkhaptics")
  message(FATAL_ERROR "headers outside of include/vtkhaptics: ${loose}")
endif ()

file(WRITE "${first}/share/doc/another/file" "")
run("${CMAKE_COMMAND}" --build "${BUILD}" --target uninstall)
file(GLOB_RECURSE left LIST_DIRECTORIES true RELATIVE "${first}" "${first}/*")
if (NOT left STREQUAL "share;share/doc;share/doc/another;share/doc/another/file")
  message(FATAL_ERROR "left by the uninstall, or removed though another's: ${left}")
endif ()

file(REMOVE_RECURSE "${first}")
run("${CMAKE_COMMAND}" --install "${BUILD}" --prefix "${first}")
file(RENAME "${first}" "${PREFIX}")
