# Generates deck/rule_id.hpp: an enumerator for every number that a page of schemas/rules can
# have, so that a new page rebuilds nothing but what names it (tests/lint/check_rule_ids.py: what is
# named has a page). Sets DECK_RULES (the pages) and DECK_GENERATED (the include folder).
file(GLOB DECK_RULES CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/schemas/rules/*)
list(SORT DECK_RULES)
set(DECK_GENERATED ${CMAKE_CURRENT_BINARY_DIR}/include)
foreach(page ${DECK_RULES})
  get_filename_component(name ${page} NAME)
  if(NOT name MATCHES "^DK([0-9][0-9][0-9])\\.md$" OR name STREQUAL "DK000.md")
    message(FATAL_ERROR "${page}: the page of a rule must be named DKnnn.md")
  endif()
endforeach()
set(rule_ids "")
foreach(number RANGE 1 999)
  string(REGEX MATCH "...$" digits "00${number}")
  string(APPEND rule_ids "  DK${digits} = ${number},\n")
endforeach()
configure_file(${CMAKE_CURRENT_LIST_DIR}/rule_id.hpp.in ${DECK_GENERATED}/deck/rule_id.hpp @ONLY)
