# What keeps the build short.

# Code that runs once per deck or per finding is hardly optimised, loops over pairs fully.
target_link_libraries(libdeck_cold PRIVATE deck_lightly)
target_compile_options(libdeck_loops PRIVATE $<$<CONFIG:Release>:-O3>)
file(GLOB kernels CONFIGURE_DEPENDS cycle/kernel/kernels*.cpp)
set_property(SOURCE ${kernels} contact/distance/filtered_exact_cgal.cpp APPEND PROPERTY COMPILE_OPTIONS $<$<CONFIG:Release>:-O3>)

# Headers of the standard library and of fmt are compiled once for each target. They are named without
# a path, so that a compiler cache serves every checkout of the project.
function(deck_precompile target) # deck_precompile(TARGET [HEADER ...]): those headers, too
  target_include_directories(${target} PRIVATE ${PROJECT_SOURCE_DIR}/libdeck/cmake)
  target_precompile_headers(${target} PRIVATE <precompiled.hpp> ${ARGN})
endfunction()
if(LIBDECK_PRECOMPILE)
  deck_precompile(libdeck)
  deck_precompile(libdeck_cold)
  if(NOT LIBDECK_UNITY) # these are one file
    deck_precompile(libdeck_loops)
  endif()
  # Other registers, other headers; data.
  set_source_files_properties(cycle/kernel/kernels_avx2.cpp cycle/kernel/kernels_avx512.cpp
    cycle/kernel/kernels_baseline.cpp ${DECK_EMBEDDED} ${DECK_EMBEDDED_VIEWER}
    PROPERTIES SKIP_PRECOMPILE_HEADERS ON)
endif()

# A build from nothing compiles two dozen files as one, more of those that are hardly optimised.
if(LIBDECK_UNITY)
  set_target_properties(libdeck libdeck_loops libdeck_cgal PROPERTIES UNITY_BUILD ON
                        UNITY_BUILD_BATCH_SIZE 24)
  set_target_properties(libdeck_cold PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 50)
  set_source_files_properties(${DECK_EMBEDDED} ${DECK_EMBEDDED_VIEWER}
    PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
endif()
