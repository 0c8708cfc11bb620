# Writes LIST, which ctest reads: a test for each suite of the GoogleTest program PROGRAM, but for those named in APART
# one for each of their tests. Skipped is what skips all of its tests and fails none. COSTS are pairs "suite=seconds".
cmake_policy(VERSION 3.25)

execute_process(COMMAND ${PROGRAM} --gtest_list_tests OUTPUT_VARIABLE listed COMMAND_ERROR_IS_FATAL ANY)
set(skipped [==[PASSED  \] 0 tests\.
\[  SKIPPED \] [0-9]+ tests?, listed below:
(\[  SKIPPED \][^
]*
)+$]==])
set(script "set(skipped [==[${skipped}]==])\n")

# A test called NAME of all that FILTER takes.
function(add name filter)
  string(APPEND script "add_test([==[${name}]==] [==[${PROGRAM}]==] [==[--gtest_filter=${filter}]==])\n"
    "set_tests_properties([==[${name}]==] PROPERTIES TIMEOUT 1800 SKIP_REGULAR_EXPRESSION \"\${skipped}\"")
  foreach(pair ${COSTS})
    if(pair MATCHES "^(.*)=([0-9]+)$" AND name STREQUAL CMAKE_MATCH_1)
      string(APPEND script " COST ${CMAKE_MATCH_2}")
    endif()
  endforeach()
  set(script "${script})\n" PARENT_SCOPE)
endfunction()

string(REGEX MATCHALL "[^\n]+" lines "${listed}")
foreach(line ${lines})
  if(line MATCHES "^([^ ]+)[.]($| )")
    set(suite ${CMAKE_MATCH_1})
    if(NOT suite IN_LIST APART)
      add(${suite} ${suite}.*)
    endif()
  elseif(line MATCHES "^  ([^ ]+)" AND suite IN_LIST APART)
    add(${suite}.${CMAKE_MATCH_1} ${suite}.${CMAKE_MATCH_1})
  endif()
endforeach()
file(WRITE ${LIST} "${script}")
