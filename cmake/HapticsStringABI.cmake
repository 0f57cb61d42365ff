# Compiles with the std::string of the VTK that was found: pip's was made with libstdc++'s old one, so
# that nothing made with today's links with it.
include(CheckCXXSourceCompiles)
include(CMakePushCheckState)
cmake_push_check_state()
list(APPEND CMAKE_REQUIRED_LIBRARIES VTK::vtksys)
set(haptics_string_source "
  #include <vtksys/SystemTools.hxx>
  int main() { return vtksys::SystemTools::GetFilenameName(std::string()).empty() ? 0 : 1; }")
check_cxx_source_compiles("${haptics_string_source}" HAPTICS_VTK_HAS_TODAYS_STRINGS)
if (NOT HAPTICS_VTK_HAS_TODAYS_STRINGS)
  list(APPEND CMAKE_REQUIRED_DEFINITIONS -D_GLIBCXX_USE_CXX11_ABI=0)
  check_cxx_source_compiles("${haptics_string_source}" HAPTICS_VTK_HAS_OLD_STRINGS)
  if (NOT HAPTICS_VTK_HAS_OLD_STRINGS)
    message(FATAL_ERROR "A program of two lines cannot be linked with the VTK in ${VTK_DIR} by "
      "${CMAKE_CXX_COMPILER}. Was it made by another compiler or for another machine? The linker's "
      "words are in CMake's log, in ${CMAKE_BINARY_DIR}/CMakeFiles.")
  endif ()
  message(STATUS "VTK has libstdc++'s old strings: so has what is built here")
  add_compile_definitions(_GLIBCXX_USE_CXX11_ABI=0)
endif ()
cmake_pop_check_state()
