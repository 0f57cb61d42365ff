# Headers other than those of VTK classes are included as "haptics/ROOM/Name.h", in the build tree and
# in the installed one, so that they collide with no header of whoever includes them.
#
#   haptics_install_headers(<folder> <header>...)
#     Installs headers of the module whose CMakeLists.txt calls it. <folder> is what the headers'
#     paths are below: haptics_install_headers(haptics Math/Vec3.h) gives "haptics/Math/Vec3.h".

# In the build tree each room is a link to its sources.
# Not "include": VTK writes a Python.h there.
set(haptics_include_dir "${CMAKE_BINARY_DIR}/headers")
file(MAKE_DIRECTORY "${haptics_include_dir}/haptics")
foreach (room IN ITEMS
  Filters/Core/Math Filters/Core/Surface Filters/Core/Material Filters/Core/Contact
  Filters/Core/Tick Filters/Core/Files
  Filters Devices Interactors/Servo Interactors/Scene Interactors/View)
  get_filename_component(name "${room}" NAME)
  file(CREATE_LINK "${PROJECT_SOURCE_DIR}/${room}" "${haptics_include_dir}/haptics/${name}"
    SYMBOLIC)
endforeach ()

function (haptics_install_headers folder)
  foreach (header IN LISTS ARGN)
    get_filename_component(room "${header}" DIRECTORY)
    vtk_module_install_headers(FILES "${header}" SUBDIR "${folder}/${room}")
  endforeach ()
endfunction ()
