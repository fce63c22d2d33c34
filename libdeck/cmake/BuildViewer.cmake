# Build step of EmbedViewer.cmake: installs the packages of the lock file (once, in the build directory;
# an existing node_modules beside the sources is used) and runs esbuild. MODE=AUTO: if packages are not
# available, the build continues without viewer and prints that.
set(modules ${SOURCE}/node_modules)
if(NOT EXISTS ${modules}/esbuild OR NOT EXISTS ${modules}/three)
  set(modules ${WORK}/node_modules)
  file(MAKE_DIRECTORY ${WORK})
  file(SHA256 ${SOURCE}/package-lock.json lock)
  set(stamp ${WORK}/installed-${lock})
  if(NOT EXISTS ${stamp})
    configure_file(${SOURCE}/package.json ${WORK}/package.json COPYONLY)
    configure_file(${SOURCE}/package-lock.json ${WORK}/package-lock.json COPYONLY)
    execute_process(COMMAND ${NPM} ci --omit=dev --ignore-scripts --no-audit --no-fund
                    WORKING_DIRECTORY ${WORK} RESULT_VARIABLE code OUTPUT_VARIABLE log
                    ERROR_VARIABLE log)
    if(NOT code EQUAL 0)
      if(MODE STREQUAL "ON")
        message(FATAL_ERROR "npm ci failed:\n${log}")
      endif()
      message(WARNING "npm ci failed, so 'deck gaps --html' will not work in this build "
                      "(LIBDECK_VIEWER=ON makes this an error):\n${log}")
      set(why "npm could not install its packages at build time. With a network, touch tools/viewer/build.mjs and build again")
      configure_file(${CMAKE_CURRENT_LIST_DIR}/no_viewer.cpp.in ${OUT} @ONLY)
      return()
    endif()
    file(WRITE ${stamp} "")
  endif()
endif()
execute_process(COMMAND ${NODE} ${SOURCE}/build.mjs --modules ${modules} --cpp ${OUT}
                RESULT_VARIABLE code)
if(NOT code EQUAL 0)
  file(REMOVE ${OUT})
  message(FATAL_ERROR "bundling the viewer failed")
endif()
