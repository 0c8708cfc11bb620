# Neither configuring with -ffast-math nor compiling a header of the scalars with it may succeed; without it both do.
file(REMOVE_RECURSE ${BINARY})
execute_process(COMMAND ${CMAKE_COMMAND} -S ${SOURCE} -B ${BINARY} -G ${GENERATOR} -D CMAKE_CXX_COMPILER=${COMPILER}
  -D CMAKE_CXX_FLAGS=-ffast-math RESULT_VARIABLE status OUTPUT_QUIET ERROR_VARIABLE errors)
if(status EQUAL 0 OR NOT errors MATCHES "-ffast-math is refused")
  message(FATAL_ERROR "configuring with -ffast-math ended with ${status}: ${errors}")
endif()

set(compile ${COMPILER} -std=c++20 -I${SOURCE} -fsyntax-only -x c++ ${SOURCE}/scalars/interval.hpp)
execute_process(COMMAND ${compile} RESULT_VARIABLE status OUTPUT_QUIET ERROR_VARIABLE errors)
if(NOT status EQUAL 0)
  message(FATAL_ERROR "the header does not compile even without -ffast-math: ${errors}")
endif()
foreach(flag -ffast-math -Ofast -ffinite-math-only)
  execute_process(COMMAND ${compile} ${flag} RESULT_VARIABLE status OUTPUT_QUIET ERROR_VARIABLE errors)
  if(status EQUAL 0 OR NOT errors MATCHES "#error")
    message(FATAL_ERROR "compiling with ${flag} ended with ${status}: ${errors}")
  endif()
endforeach()
