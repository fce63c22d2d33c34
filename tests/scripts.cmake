# Tests that run the program, as tests of CTest. Labels: cli, browser (Chromium and node), editor (language
# server, VS Code, Neovim, Emacs), slow (only `tools/test --all`). Each script counts for one test; its own
# last line, "N passed, N failed", is in the log.
if(NOT TARGET deck OR CMAKE_CROSSCOMPILING)
  return()
endif()

# Debian's python3 has the JSON Schema validator from apt; another python3 first in PATH may not.
set(python /usr/bin/python3)
execute_process(COMMAND python3 -c "import jsonschema" RESULT_VARIABLE without OUTPUT_QUIET ERROR_QUIET)
if(NOT without)
  set(python python3)
endif()
set(deck $<TARGET_FILE:deck>)

# script(NAME LABEL COMMAND...): passes if the command ends with 0 and no check of it failed.
function(script name label)
  add_test(NAME "${name}" COMMAND ${ARGN} WORKING_DIRECTORY ${PROJECT_SOURCE_DIR})
  set_tests_properties("${name}" PROPERTIES
    LABELS ${label} TIMEOUT 1800 COST 1000 # before the unit tests, which fill the gaps
    ENVIRONMENT PYTHONDONTWRITEBYTECODE=1
    FAIL_REGULAR_EXPRESSION "passed, [1-9][0-9]* failed"
    SKIP_REGULAR_EXPRESSION "(^|\n)0 passed, 0 failed, [1-9]")
endfunction()

# python(NAME LABEL FILE [ARGUMENTS]): a script of Python that takes the program first.
function(python_script name label file)
  script("${name}" ${label} ${python} ${file} ${deck} ${ARGN})
endfunction()

script("report in a browser" browser tests/browser/run ${deck})
# Holds the page's first picture and sliders to times: it has the machine to itself.
script("report in a browser, times" browser tests/browser/run ${deck} --times)
set_tests_properties("report in a browser, times" PROPERTIES RUN_SERIAL ON)
python_script("hostile input" cli tests/robustness/hostile.py)
python_script("verdicts" cli tests/robustness/verdicts.py)
python_script("bounds" cli tests/robustness/bounds.py)
python_script("outputs" cli tests/robustness/outputs.py)
python_script("a script for ParaView" cli tests/robustness/paraview.py)
python_script("batches that write" cli tests/robustness/library.py)
python_script("batch" cli tests/robustness/batch.py)
python_script("conversions" cli tests/robustness/conversions.py)
python_script("conversions in one call" cli tests/robustness/steps.py)
python_script("refused conversions" cli tests/robustness/refusals.py)
python_script("any order of blocks and rows" cli tests/robustness/order.py)
python_script("decks together" cli tests/robustness/together.py)
python_script("killed while writing" cli tests/robustness/kill.py)
python_script("short of memory, failing calls" cli tests/robustness/shortage.py)
python_script("decks" cli tests/robustness/corpus.py)
python_script("a tour in a terminal" cli tests/tools/tour.py)
python_script("man pages, completion, package" cli tests/robustness/docs.py)
file(GLOB checks RELATIVE ${PROJECT_SOURCE_DIR} CONFIGURE_DEPENDS
     keyword/check_*.py lint/check_*.py golden/check_*.py tools/check_*.py)
foreach(check ${checks})
  get_filename_component(name ${check} NAME_WE)
  python_script("${name}" cli ${check})
endforeach()
script("Python module" cli tests/python/run ${deck})
script("consumer of the installed library" cli tests/consumer/run ${PROJECT_BINARY_DIR})
python_script("language server" editor tests/lsp/run)
script("editors" editor tests/vscode/run ${deck})

# Minutes each; `tools/test --all` runs them.
script("report in a browser, all" slow tests/browser/run ${deck} --all)
python_script("hostile input, all" slow tests/robustness/hostile.py --all)
python_script("bounds, all" slow tests/robustness/bounds.py --all)
python_script("conversions, all" slow tests/robustness/conversions.py --all)
python_script("killed while writing, all" slow tests/robustness/kill.py --all)
python_script("batches that write, all" slow tests/robustness/library.py --all)
python_script("short of memory, failing calls, all" slow tests/robustness/shortage.py --all)
python_script("a tour in a terminal, all" slow tests/tools/tour.py --all)
python_script("language server, all" slow tests/lsp/run --all)
script("editors, all" slow tests/vscode/run ${deck} --all)
script("Python module from nothing" slow tests/python/run --clean ${deck})
script("clang-tidy" slow ${python} tests/tools/tidy --all)
script("sources for 32 bits" slow ${python} tests/tools/narrow)
script("every public header alone" slow tests/consumer/run --all ${PROJECT_BINARY_DIR})
