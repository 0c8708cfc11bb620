# Fast mathematics is refused twice, under either compiler: by CMake wherever the flag is given to the whole project, and
# by the headers where only a target has it. What a header cannot see must leave its bounds as they are.
# In: SOURCE, BINARY, GENERATOR, COMPILER. Says "skipped" where the compiler is missing.
find_program(found ${COMPILER})
if(NOT found)
  message("skipped: there is no ${COMPILER}")
  return()
endif()
file(REMOVE_RECURSE ${BINARY})
file(MAKE_DIRECTORY ${BINARY}/parent)

# ---- CMake ----------------------------------------------------------------------------------------------------------

function(expect_refusal flag folder)
  execute_process(COMMAND ${CMAKE_COMMAND} -S ${folder} -B ${BINARY}/build -G ${GENERATOR}
    -D CMAKE_CXX_COMPILER=${COMPILER} ${ARGN} RESULT_VARIABLE status OUTPUT_QUIET ERROR_VARIABLE errors)
  if(status EQUAL 0 OR NOT errors MATCHES "${flag} is refused")
    message(FATAL_ERROR "configuring with ${flag} (${ARGN}) ended with ${status}: ${errors}")
  endif()
endfunction()

# The flags are only read: what is refused to g++, clang's too, need not be refused to clang once more.
set(flags -ffast-math)
if(NOT COMPILER MATCHES clang)
  list(APPEND flags -Ofast -ffinite-math-only -funsafe-math-optimizations -fassociative-math -freciprocal-math
    -fno-signed-zeros -fsingle-precision-constant -mfpmath=387
    -ffp-model=fast -fapprox-func -fno-honor-nans -fdenormal-fp-math=preserve-sign)
endif()
foreach(flag ${flags})
  expect_refusal(${flag} ${SOURCE} -D CMAKE_CXX_FLAGS_RELWITHDEBINFO=${flag})
endforeach()
expect_refusal(-ffast-math ${SOURCE} -D CMAKE_CXX_FLAGS_RELWITHDEBINFO= -D "CMAKE_CXX_FLAGS=-O2 -ffast-math")
expect_refusal(-ffast-math ${SOURCE} -D CMAKE_CXX_FLAGS= -D CMAKE_EXE_LINKER_FLAGS=-ffast-math)

# Gamut inside another project, which sets the flag for its folders.
file(WRITE ${BINARY}/parent/CMakeLists.txt "cmake_minimum_required(VERSION 3.25)\nproject(Parent LANGUAGES C CXX)
add_compile_options($<$<COMPILE_LANGUAGE:CXX>:-ffinite-math-only>)\nadd_subdirectory(${SOURCE} gamut)\n")
file(REMOVE_RECURSE ${BINARY}/build)
expect_refusal(-ffinite-math-only ${BINARY}/parent)

# ---- The headers ----------------------------------------------------------------------------------------------------

set(compile ${COMPILER} -std=c++20 -O2 -I${SOURCE} ${CMAKE_CURRENT_LIST_DIR}/fast_math.cpp)
set(library ${BINARY}/rounding.o)
execute_process(COMMAND ${COMPILER} -std=c++20 -O2 -I${SOURCE} -c ${SOURCE}/scalars/elementary/rounding.cpp -o ${library}
  COMMAND_ERROR_IS_FATAL ANY)

# Compiled with these flags fast_math.cpp is refused by an #error, or, where that is allowed, its bounds are right.
function(check_header refusal_needed)
  execute_process(COMMAND ${compile} ${ARGN} -c -o ${BINARY}/bounds.o RESULT_VARIABLE status OUTPUT_QUIET ERROR_VARIABLE errors)
  if(status EQUAL 0)
    execute_process(COMMAND ${COMPILER} ${BINARY}/bounds.o ${library} -o ${BINARY}/bounds COMMAND_ERROR_IS_FATAL ANY)
    execute_process(COMMAND ${BINARY}/bounds RESULT_VARIABLE wrong)
    if(refusal_needed OR NOT wrong EQUAL 0)
      message(FATAL_ERROR "${COMPILER} ${ARGN}: compiled, and the bounds' check returned ${wrong}")
    endif()
  elseif(NOT ARGN OR NOT errors MATCHES "Gamut's bounds need")
    message(FATAL_ERROR "${COMPILER} ${ARGN} ended with ${status}: ${errors}")
  endif()
endfunction()

set(reassociating "-fassociative-math;-fno-signed-zeros;-fno-trapping-math")
check_header(FALSE)
foreach(flag -ffast-math -Ofast -ffinite-math-only)
  check_header(TRUE ${flag})
endforeach()
if(COMPILER MATCHES clang)
  # clang tells no more to the preprocessor: its pragma keeps the header as it is written.
  check_header(TRUE -ffp-model=fast)
  foreach(flag -funsafe-math-optimizations -freciprocal-math -fno-signed-zeros -fapprox-func)
    check_header(FALSE ${flag})
  endforeach()
  check_header(FALSE ${reassociating})
else()
  foreach(flag -funsafe-math-optimizations -freciprocal-math -fno-signed-zeros -mfpmath=387)
    check_header(TRUE ${flag})
  endforeach()
  check_header(TRUE ${reassociating})
endif()
