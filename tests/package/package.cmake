# Installs Gamut below BINARY, builds the programs in SOURCE and the README's against it and runs them: outside returns 0
# only if its enclosure is right.
function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT status EQUAL 0)
    list(JOIN ARGN " " command)
    message(FATAL_ERROR "${command}\nended with ${status}:\n${output}")
  endif()
  set(output "${output}" PARENT_SCOPE)
endfunction()

file(REMOVE_RECURSE ${BINARY}/prefix ${BINARY}/build)
run(${CMAKE_COMMAND} --install ${GAMUT} --config ${CONFIG} --prefix ${BINARY}/prefix)

file(READ ${README} readme)
if(NOT readme MATCHES "```cpp\n([^`]*)```")
  message(FATAL_ERROR "${README} shows no program")
endif()
file(WRITE ${BINARY}/readme.cpp "${CMAKE_MATCH_1}")

run(${CMAKE_COMMAND} -S ${SOURCE} -B ${BINARY}/build -G ${GENERATOR} -D CMAKE_CXX_COMPILER=${COMPILER}
  -D CMAKE_PREFIX_PATH=${BINARY}/prefix -D CMAKE_BUILD_TYPE=${CONFIG} "-D CMAKE_CXX_FLAGS=${FLAGS}"
  -D README_PROGRAM=${BINARY}/readme.cpp)
run(${CMAKE_COMMAND} --build ${BINARY}/build --config ${CONFIG})
run(${BINARY}/build/outside)
message("${output}")
run(${BINARY}/build/readme)
message("${output}")
if(NOT output MATCHES "^angle after 5 s: .*, proved up to 10 s\n$")
  message(FATAL_ERROR "the README's program did not enclose the motion")
endif()
run(${BINARY}/prefix/bin/gamut --version)
