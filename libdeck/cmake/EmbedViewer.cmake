# Adds a generated source with the viewer of `deck gaps --html` to DECK_EMBEDDED_VIEWER. The viewer
# is TypeScript (tools/viewer) bundled by esbuild with the packages of its lock file; the bundle is not
# committed. Without npm the generated source explains how to get the viewer.
set(LIBDECK_VIEWER AUTO CACHE STRING "Viewer of the HTML report: AUTO (where npm is there), ON, OFF")
set_property(CACHE LIBDECK_VIEWER PROPERTY STRINGS AUTO ON OFF)

set(viewer_dir ${PROJECT_SOURCE_DIR}/tools/viewer)
set(DECK_EMBEDDED_VIEWER ${CMAKE_CURRENT_BINARY_DIR}/embedded_viewer.cpp)
set(mode ${LIBDECK_VIEWER})
if(NOT mode STREQUAL "OFF")
  find_program(DECK_NPM npm)
  find_program(DECK_NODE NAMES node nodejs)
  if(NOT DECK_NPM OR NOT DECK_NODE)
    if(mode STREQUAL "ON")
      message(FATAL_ERROR "LIBDECK_VIEWER=ON needs npm and node (Debian: apt-get install npm)")
    endif()
    message(STATUS "No npm: 'deck gaps --html' will not work in this build. To get it, install npm "
                   "(Debian: apt-get install npm) and configure again.")
    set(mode "OFF")
  endif()
endif()

if(mode STREQUAL "OFF")
  set(why "it was configured without npm or with LIBDECK_VIEWER=OFF. Install npm and build again")
  configure_file(${CMAKE_CURRENT_LIST_DIR}/no_viewer.cpp.in ${DECK_EMBEDDED_VIEWER} @ONLY)
else()
  file(GLOB_RECURSE viewer_sources CONFIGURE_DEPENDS ${viewer_dir}/src/*.ts ${viewer_dir}/src/*.css)
  add_custom_command(
    OUTPUT ${DECK_EMBEDDED_VIEWER}
    COMMAND ${CMAKE_COMMAND} -DMODE=${mode} -DNPM=${DECK_NPM} -DNODE=${DECK_NODE}
            -DSOURCE=${viewer_dir} -DWORK=${CMAKE_CURRENT_BINARY_DIR}/viewer
            -DOUT=${DECK_EMBEDDED_VIEWER} -P ${CMAKE_CURRENT_LIST_DIR}/BuildViewer.cmake
    DEPENDS ${viewer_sources} ${viewer_dir}/build.mjs ${viewer_dir}/package.json
            ${viewer_dir}/package-lock.json ${CMAKE_CURRENT_LIST_DIR}/BuildViewer.cmake
            ${CMAKE_CURRENT_LIST_DIR}/no_viewer.cpp.in
    COMMENT "Bundling the viewer of the HTML report")
endif()
