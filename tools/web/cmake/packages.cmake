# The packages of the build for WebAssembly: what find_package() gives natively, from the headers that
# Debian installs for the host. Included behind project() (CMAKE_PROJECT_libdeck_INCLUDE), with
# DECK_ZLIB_SOURCE naming an unpacked source of zlib. See tools/web/build.
enable_language(C) # zlib
if(NOT EMSCRIPTEN)
  message(FATAL_ERROR "packages.cmake is for emscripten; other systems have packages of their own")
endif()

# Exceptions and two lanes of doubles as the machine knows them. `.cache` files of emscripten need no
# rebuild for these: Debian ships its libraries for both kinds of exceptions.
add_compile_options(-fwasm-exceptions -msimd128)
add_link_options(-fwasm-exceptions)
set(CMAKE_CXX_COMPILE_OPTIONS_PIC "") # one module, nothing to relocate

# Headers only: the folder /usr/include as a whole would bring those of the host's C library.
set(headers ${CMAKE_BINARY_DIR}/headers)
file(MAKE_DIRECTORY ${headers})
foreach(name boost CGAL CLI eigen3 fmt nlohmann toml++)
  if(NOT EXISTS /usr/include/${name})
    message(FATAL_ERROR "/usr/include/${name} is missing (tools/setup installs it)")
  endif()
  file(CREATE_LINK /usr/include/${name} ${headers}/${name} SYMBOLIC)
endforeach()

# find_package() of these is answered by an empty file; the targets are below.
foreach(name threads fmt nlohmann_json eigen3 zlib cgal cli11 tomlplusplus)
  file(WRITE ${CMAKE_FIND_PACKAGE_REDIRECTS_DIR}/${name}-config.cmake "")
endforeach()
function(package name)
  add_library(${name} INTERFACE IMPORTED GLOBAL)
  target_include_directories(${name} SYSTEM INTERFACE ${headers} ${ARGN})
endfunction()
package(Threads::Threads)
package(nlohmann_json::nlohmann_json)
package(CLI11::CLI11)
package(Eigen3::Eigen ${headers}/eigen3)
package(tomlplusplus::tomlplusplus)
target_compile_definitions(tomlplusplus::tomlplusplus INTERFACE TOML_HEADER_ONLY=1)

# No GMP: CGAL takes the numbers of Boost. The rounding of this machine is fixed: CGAL's intervals
# are widened by one step instead.
package(CGAL::CGAL)
target_compile_definitions(CGAL::CGAL INTERFACE CGAL_ALWAYS_ROUND_TO_NEAREST CGAL_DISABLE_GMP
                           BOOST_ALL_NO_LIB)
foreach(name gmp gmpxx mpfr)
  add_library(${name} INTERFACE IMPORTED GLOBAL)
endforeach()

package(fmt::fmt)
add_library(fmt_compiled STATIC ${CMAKE_SOURCE_DIR}/tools/static/fmt.cpp)
target_link_libraries(fmt_compiled PRIVATE fmt::fmt)
set_target_properties(fmt_compiled PROPERTIES CXX_STANDARD 20)
set_property(TARGET fmt::fmt APPEND PROPERTY INTERFACE_LINK_LIBRARIES $<LINK_ONLY:fmt_compiled>)

package(ZLIB::ZLIB ${DECK_ZLIB_SOURCE})
set(zlib_sources)
foreach(name adler32 compress crc32 deflate inffast inflate inftrees trees uncompr zutil)
  list(APPEND zlib_sources ${DECK_ZLIB_SOURCE}/${name}.c)
endforeach()
add_library(zlib_compiled STATIC ${zlib_sources})
target_compile_options(zlib_compiled PRIVATE -w)
set_property(TARGET ZLIB::ZLIB APPEND PROPERTY INTERFACE_LINK_LIBRARIES $<LINK_ONLY:zlib_compiled>)
