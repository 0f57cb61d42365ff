# Finds VTK, or ParaView with the VTK inside it. Also installed, for projects that use VTKHaptics.
#
#   haptics_find_vtk(<paraview>)
#
# <paraview> true: ParaView is required. False: VTK 9.1 or later is, be it ParaView's own.
# A macro, since find_package() leaves variables that the caller needs.

# Debian 13's ParaView package has a fault: its CMake files name the Python modules vtkX.so where it
# installs vtkX.cpython-313-x86_64-linux-gnu.so, so that finding it fails. This makes <prefix>, a
# folder of links to every file that those CMake files name, with the Python modules under both
# names: no root needed, nothing of the system touched.
function (haptics_link_debian_paraview package_dir prefix)
  file(GLOB_RECURSE cmake_files RELATIVE "/usr" "${package_dir}/*")
  set(named_paths)
  foreach (file IN LISTS cmake_files)
    get_filename_component(folder "${prefix}/${file}" DIRECTORY)
    file(MAKE_DIRECTORY "${folder}")
    file(CREATE_LINK "/usr/${file}" "${prefix}/${file}" SYMBOLIC)
    file(STRINGS "/usr/${file}" lines REGEX "import_prefix}/|_IMPORT_PREFIX}/")
    string(REGEX MATCHALL "(import_prefix|_IMPORT_PREFIX)}/[^\";> )$]+" matches "${lines}")
    list(APPEND named_paths ${matches})
  endforeach ()
  list(TRANSFORM named_paths REPLACE "^(import_prefix|_IMPORT_PREFIX)}/" "")
  list(REMOVE_DUPLICATES named_paths)
  # Shortest first: a folder that is named itself becomes one link. /usr/include must not become
  # one, since the compiler would then search it before its own headers.
  list(SORT named_paths)
  list(REMOVE_ITEM named_paths "include" "include/" "lib" "bin")
  foreach (path IN LISTS named_paths)
    string(REGEX REPLACE "/$" "" path "${path}")
    set(file "/usr/${path}")
    if (NOT EXISTS "${file}" AND path MATCHES "^(.*)\\.so$")
      file(GLOB file "/usr/${CMAKE_MATCH_1}.cpython-*.so")
    endif ()
    if (file AND EXISTS "${file}" AND NOT EXISTS "${prefix}/${path}")
      get_filename_component(folder "${prefix}/${path}" DIRECTORY)
      file(MAKE_DIRECTORY "${folder}")
      file(CREATE_LINK "${file}" "${prefix}/${path}" SYMBOLIC)
    endif ()
  endforeach ()
endfunction ()

# Where the ParaView of Debian's packages is to be found; empty if there is none.
function (haptics_debian_paraview_dir result)
  file(GLOB package_dirs "/usr/lib/*/cmake/paraview-*")
  list(SORT package_dirs)
  list(POP_BACK package_dirs package_dir)
  set(modules "/usr/lib/python3/dist-packages/vtkmodules")
  file(GLOB suffixed_module "${modules}/vtkCommonCore.cpython-*.so")
  if (package_dir AND suffixed_module AND NOT EXISTS "${modules}/vtkCommonCore.so")
    set(prefix "${CMAKE_BINARY_DIR}/debian-paraview")
    haptics_link_debian_paraview("${package_dir}" "${prefix}")
    string(REGEX REPLACE "^/usr" "${prefix}" package_dir "${package_dir}")
  endif ()
  set("${result}" "${package_dir}" PARENT_SCOPE)
endfunction ()

macro (haptics_find_vtk paraview)
  set(haptics_paraview_dir)
  if (NOT ParaView_DIR AND NOT VTK_DIR)
    haptics_debian_paraview_dir(haptics_paraview_dir)
  endif ()
  if (${paraview})
    find_package(ParaView 5.11 REQUIRED HINTS "${haptics_paraview_dir}")
  elseif (haptics_paraview_dir)
    find_package(VTK 9.1 REQUIRED HINTS "${haptics_paraview_dir}/vtk")
  else ()
    find_package(VTK 9.1 REQUIRED)
  endif ()
endmacro ()
