# Installs Gamut below BINARY, builds the programs in SOURCE and the README's against it and runs them: outside returns 0
# only if its enclosure is right. Then rooms alone, and what the package refuses, in ROOMS. Headers are installed that
# these programs and those of the GUIDES include, and what those include: no other, and none is missing.
cmake_policy(VERSION 3.25)
set(quickly -D CMAKE_CXX_FLAGS_RELEASE=-O1)  # of what is compiled here, which takes most of the time

function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT status EQUAL 0)
    list(JOIN ARGN " " command)
    message(FATAL_ERROR "${command}\nended with ${status}:\n${output}")
  endif()
  set(output "${output}" PARENT_SCOPE)
endfunction()

# Configures ROOMS for a component with such compiler flags; with a further argument it must fail, saying that.
function(configure_rooms component flags)
  set(command ${CMAKE_COMMAND} -S ${ROOMS} -B ${BINARY}/rooms -G ${GENERATOR} -D CMAKE_CXX_COMPILER=${COMPILER}
    -D CMAKE_PREFIX_PATH=${BINARY}/prefix -D CMAKE_BUILD_TYPE=${CONFIG} "-D CMAKE_CXX_FLAGS=${flags}" ${quickly}
    -D COMPONENT=${component})
  file(REMOVE_RECURSE ${BINARY}/rooms)
  if(NOT ARGN)
    run(${command})
    return()
  endif()
  execute_process(COMMAND ${command} RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output)
  string(REGEX REPLACE "[ \n]+" " " output "${output}")
  string(FIND "${output}" "${ARGN}" place)
  if(status EQUAL 0 OR place EQUAL -1)
    message(FATAL_ERROR "the component ${component} with ${flags} was not refused with '${ARGN}':\n${output}")
  endif()
endfunction()

file(REMOVE_RECURSE ${BINARY}/prefix ${BINARY}/build)
run(${CMAKE_COMMAND} --install ${GAMUT} --config ${CONFIG} --prefix ${BINARY}/prefix)

file(GLOB_RECURSE installed ${BINARY}/prefix/share/doc/*/README.md)
cmake_path(GET installed PARENT_PATH documents)
file(READ ${README} readme)
string(REGEX MATCHALL "\\((docs/[^)]*\\.md|studies/[^)]*|LICENSE)\\)" links "${readme}")
foreach(link ${links})
  string(REGEX REPLACE "[()]" "" link "${link}")
  if(NOT EXISTS ${documents}/${link})
    message(FATAL_ERROR "the installed README's link ${link} leads nowhere")
  endif()
endforeach()
if(NOT readme MATCHES "```cpp\n([^`]*)```")
  message(FATAL_ERROR "${README} shows no program")
endif()
file(WRITE ${BINARY}/readme.cpp "${CMAKE_MATCH_1}")

run(${CMAKE_COMMAND} -S ${SOURCE} -B ${BINARY}/build -G ${GENERATOR} -D CMAKE_CXX_COMPILER=${COMPILER}
  -D CMAKE_PREFIX_PATH=${BINARY}/prefix -D CMAKE_BUILD_TYPE=${CONFIG} "-D CMAKE_CXX_FLAGS=${FLAGS}" ${quickly}
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

foreach(room scalars mechanics reports)
  configure_rooms(${room} "${FLAGS}")
  run(${CMAKE_COMMAND} --build ${BINARY}/rooms --config ${CONFIG})
  run(${CMAKE_COMMAND} -E chdir ${BINARY} ${BINARY}/rooms/rooms ${documents}/studies/examples/tip_position/study.toml)
endforeach()
configure_rooms(intervals "${FLAGS}"
  "Gamut has no component 'intervals', its components are scalars, mechanics, analyses, studies, reports")
configure_rooms(scalars "${FLAGS} -ffast-math" "-ffast-math is refused")

# What the guides show of CMake finds what it names.
foreach(guide ${README} ${GUIDES})
  file(READ ${guide} text)
  if(text MATCHES "```cmake\n([^`]*)```")
    file(WRITE ${BINARY}/shown/app.cpp "int main() {}\n")
    file(WRITE ${BINARY}/shown/CMakeLists.txt
      "cmake_minimum_required(VERSION 3.25)\nproject(Shown LANGUAGES C CXX)\nadd_executable(app app.cpp)\n${CMAKE_MATCH_1}")
    run(${CMAKE_COMMAND} -S ${BINARY}/shown -B ${BINARY}/shown/build --fresh -G ${GENERATOR}
      -D CMAKE_CXX_COMPILER=${COMPILER} -D CMAKE_PREFIX_PATH=${BINARY}/prefix)
  endif()
endforeach()

# ---- Headers --------------------------------------------------------------------------------------------------------

# Appends to `waiting` what the files include of Gamut, with its place below include/gamut.
function(note_includes)
  foreach(file ${ARGN})
    file(STRINGS ${file} lines REGEX "^ *# *include *[<\"][a-z_]+/")
    foreach(line ${lines})
      string(REGEX REPLACE "^[^<\"]*[<\"](gamut/)?([^>\"]*)[>\"].*" "\\2" header "${line}")
      if(header MATCHES "^(scalars|mechanics|analyses|studies|reports)/|^[a-z]+[.]hpp$")
        list(APPEND waiting ${header})
      endif()
    endforeach()
  endforeach()
  set(waiting ${waiting} PARENT_SCOPE)
endfunction()

set(place ${BINARY}/prefix/include/gamut)
file(GLOB_RECURSE unneeded RELATIVE ${place} ${place}/*)
list(LENGTH unneeded count)
file(GLOB programs ${SOURCE}/*.cpp ${ROOMS}/*.cpp)
set(waiting "")
note_includes(${programs} ${BINARY}/readme.cpp ${GUIDES})
set(needed "")
while(waiting)
  list(POP_FRONT waiting header)
  if(NOT header IN_LIST needed)
    if(NOT EXISTS ${place}/${header})
      message(FATAL_ERROR "${header}, which users include, is not installed")
    endif()
    list(APPEND needed ${header})
    note_includes(${place}/${header})
  endif()
endwhile()
list(REMOVE_ITEM unneeded ${needed})
if(unneeded)
  message(FATAL_ERROR "installed, but neither the guides nor the programs outside include: ${unneeded}")
endif()
message("${count} headers are installed, and all are needed")
