# The loops over gathered facets become vector instructions only where errno, floating-point
# exceptions and other rounding modes (which CGAL's headers ask for) are of no interest.
foreach (source IN ITEMS
    Contact/FacetBatch.cxx Contact/FacetTable.cxx Contact/Neighbourhood.cxx
    Contact/SeparatingPlanes.cxx Contact/WorkingSet.cxx Surface/WideBvh.cxx)
  if (NOT EXISTS "${CMAKE_CURRENT_LIST_DIR}/${source}")
    message(FATAL_ERROR "${CMAKE_CURRENT_LIST_FILE} names ${source}, which is not there")
  endif ()
  set_source_files_properties("${CMAKE_CURRENT_LIST_DIR}/${source}" PROPERTIES
    COMPILE_OPTIONS "-fno-rounding-math;-fno-math-errno;-fno-trapping-math")
endforeach ()
