# Of itself alone, so that contact.sh can include it in the build of another commit.
add_executable(HapticsStrokeReplay "${CMAKE_CURRENT_LIST_DIR}/StrokeReplay.cxx")
target_link_libraries(HapticsStrokeReplay PRIVATE Haptics::Core)
target_compile_options(HapticsStrokeReplay PRIVATE -Wall -Wextra)
