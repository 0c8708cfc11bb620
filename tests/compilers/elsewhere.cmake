# Builds the program TEST (a .cpp beside this file) with its SOURCES (most together, those APART on their own) in FOLDER by
# COMPILER with FLAGS, runs it in two threads, and compares the digest that it prints with that of the program REFERENCE,
# the project's own build. If CALLER names a flag, once more with TEST compiled with that flag too; if RUNNER names a
# program, once more by that program. Says "skipped" where the compiler, the runner or the machine's instructions are
# missing.
cmake_policy(VERSION 3.25)
separate_arguments(FLAGS)
separate_arguments(RUNNER)
if(RUNNER)
  list(GET RUNNER 0 runner)
endif()
foreach(program ${COMPILER} ${runner})
  find_program(found_${program} ${program})
  if(NOT found_${program})
    message("skipped: there is no ${program}")
    return()
  endif()
endforeach()
file(REMOVE_RECURSE ${FOLDER})
file(MAKE_DIRECTORY ${FOLDER})

foreach(folder ${SYSTEM_INCLUDES})
  list(APPEND includes -idirafter ${folder})
endforeach()
function(compile source object)
  execute_process(COMMAND ${COMPILER} -std=c++20 ${ARGN} -I${SOURCE} ${includes} -c ${source} -o ${FOLDER}/${object}
    COMMAND_ERROR_IS_FATAL ANY)
endfunction()
# In one run of the compiler, which reads headers once; apart what defines for itself what others define too.
set(together ${FOLDER}/together.cpp)
foreach(source ${SOURCES})
  cmake_path(GET source STEM stem)
  if(NOT stem IN_LIST APART)
    file(APPEND ${together} "#include \"${source}\"\n")
    list(REMOVE_ITEM SOURCES ${source})
  endif()
endforeach()
foreach(source ${together} ${SOURCES})
  cmake_path(GET source STEM object)
  compile(${source} ${object}.o ${FLAGS} -ffp-contract=off)
  list(APPEND objects ${FOLDER}/${object}.o)
endforeach()

execute_process(COMMAND ${REFERENCE} OUTPUT_VARIABLE expected)  # whether it fails is a test of its own

# build(FLAG...): the test, compiled with these flags besides FLAGS.
function(build)
  compile(${CMAKE_CURRENT_LIST_DIR}/${TEST}.cpp test.o ${FLAGS} ${ARGN})
  execute_process(COMMAND ${COMPILER} ${FLAGS} ${FOLDER}/test.o ${objects} ${LINK} -pthread -o ${FOLDER}/test
    COMMAND_ERROR_IS_FATAL ANY)
endfunction()

# run(THREADS [WORD...]): the test built last, started by these words, prints the digest expected.
function(run threads)
  execute_process(COMMAND ${ARGN} ${FOLDER}/test ${threads} RESULT_VARIABLE status OUTPUT_VARIABLE output
    ERROR_VARIABLE errors ECHO_ERROR_VARIABLE)
  if(status MATCHES "[Ii]llegal")
    message("skipped: this machine lacks the instructions of ${FLAGS}")
  elseif(errors MATCHES "ThreadSanitizer: unexpected memory mapping")
    message("skipped: the sanitizer knows no way in this kernel's layout of addresses")
  elseif(NOT status EQUAL 0 OR NOT output STREQUAL expected)
    message(FATAL_ERROR "${COMPILER} ${FLAGS}: ${ARGN} ended with ${status}, expected ${expected}got ${output}")
  endif()
endfunction()

build(-ffp-contract=off)
run(2)
if(RUNNER)
  run(1 ${RUNNER})
endif()
if(CALLER)
  build(${CALLER})
  run(2)
endif()
