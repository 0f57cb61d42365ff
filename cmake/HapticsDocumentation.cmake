# `cmake --build build --target HapticsDocumentation` writes the API reference to build/html.
# A header without a docstring is no warning; one that names what does not exist is an error.
find_package(Doxygen QUIET)
if (NOT DOXYGEN_FOUND)
  return()
endif ()
set(DOXYGEN_USE_MDFILE_AS_MAINPAGE "${PROJECT_SOURCE_DIR}/README.md")
set(DOXYGEN_EXTRACT_ALL YES) # the VTK classes document their methods in groups and by macros
set(DOXYGEN_EXTRACT_STATIC YES)
set(DOXYGEN_JAVADOC_AUTOBRIEF YES)
set(DOXYGEN_DISTRIBUTE_GROUP_DOC YES)
set(DOXYGEN_MULTILINE_CPP_IS_BRIEF YES)
set(DOXYGEN_MACRO_EXPANSION YES)
set(DOXYGEN_EXPAND_ONLY_PREDEF YES)
set(DOXYGEN_PREDEFINED
  "VTKHAPTICSCORE_EXPORT=" "VTKHAPTICSFILTERS_EXPORT=" "VTKHAPTICSDEVICES_EXPORT="
  "VTKHAPTICSSERVO_EXPORT=" "VTKHAPTICSSCENE_EXPORT=" "VTKHAPTICSVIEW_EXPORT="
  "vtkTypeMacro(name,superclass)="
  "vtkGetMacro(name,type)=type Get##name()"
  "vtkSetMacro(name,type)=void Set##name(type)"
  "vtkBooleanMacro(name,type)=void name##On()\; void name##Off()"
  "vtkSetClampMacro(name,type,min,max)=void Set##name(type)"
  "vtkGetVector3Macro(name,type)=type *Get##name()")
set(DOXYGEN_EXCLUDE_PATTERNS "*/build*/*" "*/Python/*")
set(DOXYGEN_WARN_AS_ERROR FAIL_ON_WARNINGS)
set(DOXYGEN_QUIET YES)
set(DOXYGEN_GENERATE_LATEX NO)
set(DOXYGEN_HAVE_DOT NO)
doxygen_add_docs(HapticsDocumentation
  README.md Filters Devices Interactors Plugin Testing/Benchmarks/README.md Data/README.md
  WORKING_DIRECTORY "${PROJECT_SOURCE_DIR}"
  COMMENT "Writing the API reference to ${PROJECT_BINARY_DIR}/html")
