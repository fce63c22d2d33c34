# Settings for short compile times.

# Code that runs once per deck or finding uses low optimisation, loops over pairs full optimisation.
target_link_libraries(libdeck_cold PRIVATE deck_lightly)
target_compile_options(libdeck_loops PRIVATE $<$<CONFIG:Release>:-O3>)
file(GLOB kernels CONFIGURE_DEPENDS cycle/kernel/kernels*.cpp)
set_property(SOURCE ${kernels} contact/distance/filtered_exact_cgal.cpp APPEND PROPERTY COMPILE_OPTIONS $<$<CONFIG:Release>:-O3>)

# Precompiles headers of the standard library and fmt per target. Names without a path let a compiler
# cache work for every checkout.
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
  # These targets use other instruction sets or headers, or have data only.
  set_source_files_properties(cycle/kernel/kernels_avx2.cpp cycle/kernel/kernels_avx512.cpp
    cycle/kernel/kernels_baseline.cpp ${DECK_EMBEDDED} ${DECK_EMBEDDED_VIEWER}
    PROPERTIES SKIP_PRECOMPILE_HEADERS ON)
endif()

# Full builds compile two dozen files as one; more for low optimisation.
if(LIBDECK_UNITY)
  set_target_properties(libdeck libdeck_loops libdeck_cgal PROPERTIES UNITY_BUILD ON
                        UNITY_BUILD_BATCH_SIZE 24)
  set_target_properties(libdeck_cold PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 50)
  set_source_files_properties(${DECK_EMBEDDED} ${DECK_EMBEDDED_VIEWER}
    PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
endif()
