# Compile options of all targets.
# Floating-point results are part of the interface: contraction stays off and the compiler may not
# reorder arithmetic, so that g++ and clang, scalar and vector code give the same bits.
if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "" FORCE)
endif()

find_program(DECK_CCACHE ccache)
if(DECK_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  # These settings let ccache cache precompiled headers.
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CMAKE_COMMAND} -E env
      CCACHE_SLOPPINESS=pch_defines,time_macros ${DECK_CCACHE})
  add_compile_options($<$<CXX_COMPILER_ID:GNU>:-fpch-preprocess>)
endif()

set(DECK_SANITIZE "" CACHE STRING "Sanitizers, e.g. address,undefined or thread")

add_library(deck_options INTERFACE)
target_compile_options(deck_options INTERFACE -ffp-contract=off -fno-math-errno)
if(LIBDECK_UNITY) # g++ tidies its memory only from 1 GB (given in kB) on: the same code, sooner
  target_compile_options(deck_options INTERFACE
                         $<$<CXX_COMPILER_ID:GNU>:--param=ggc-min-heapsize=1000000>)
  # Other builds check format strings at compile time.
  target_compile_definitions(deck_options INTERFACE $<$<AND:$<CONFIG:Release>,$<CXX_COMPILER_ID:GNU>>:FMT_CONSTEVAL=>)
endif()
if(DECK_SANITIZE)
  target_compile_options(deck_options INTERFACE -fsanitize=${DECK_SANITIZE}
                         -fno-sanitize-recover=all -fno-omit-frame-pointer -g1
                         # a false one of g++ 12 about members of vectors
                         $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>)
  target_link_options(deck_options INTERFACE -fsanitize=${DECK_SANITIZE})
endif()

add_library(deck_warnings INTERFACE)
if(LIBDECK_WERROR)
  target_compile_options(deck_warnings INTERFACE -Wall -Wextra -Wpedantic -Wnon-virtual-dtor
                         -Woverloaded-virtual -Wcast-align -Wunused -Wformat=2 -Werror
                         # Unity builds: private names of files may shadow each other.
                         $<$<NOT:$<BOOL:${LIBDECK_UNITY}>>:-Wshadow>
                         # g++ 12 reports false overlapping or overflowing copies in std::string + literal
                         # (GCC bug 105651).
                         $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict;-Wno-array-bounds>)
else() # nobody reads them
  target_compile_options(deck_warnings INTERFACE -w)
endif()

# Low optimisation for code that runs once per deck, finding or test. g++ 12 then reports false string
# overflows (as above).
add_library(deck_lightly INTERFACE)
target_compile_options(deck_lightly INTERFACE $<$<CONFIG:Release,RelWithDebInfo>:-O1>
                       $<$<CXX_COMPILER_ID:GNU>:-Wno-stringop-overflow;-Wno-stringop-overread>)
# Sanitizers double the compile time; no optimisation halves it.
if(DECK_SANITIZE AND NOT DECK_SANITIZE MATCHES "fuzzer")
  target_compile_options(deck_lightly INTERFACE -O0)
endif()
