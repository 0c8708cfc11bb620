# How every room is built: one static library a room, the same warnings, no arithmetic that the proofs do not allow.
# Each room is installed as an export set of its own, so that a program that needs the flow need not find HDF5.

# Rigour needs round-to-nearest and no re-association: error-free transformations live in headers, so contraction is off
# everywhere except where a file asks for it (the flow's kernels, whose certificate covers it).
function(gamut_compile_options target)
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wpedantic -Wshadow -ffp-contract=off
    $<$<BOOL:${GAMUT_WERROR}>:-Werror> ${unity_warnings})
  # g++ 12 at -O3 warns wrongly inside its own library: "text" + std::string (GCC bug 105651), < of vectors of bytes.
  if(CMAKE_CXX_COMPILER_ID STREQUAL GNU AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
    target_compile_options(${target} PRIVATE -Wno-restrict -Wno-stringop-overread)
  endif()
endfunction()

# Of sources compiled some at a time (CMAKE_UNITY_BUILD) g++ takes each for a header, in which unnamed namespaces would
# be a fault, and what one calls like another does shadows it.
set(unity_warnings "")
if(CMAKE_UNITY_BUILD AND CMAKE_CXX_COMPILER_ID STREQUAL GNU)
  set(unity_warnings -Wno-subobject-linkage -Wno-shadow)
endif()

# What computes nothing that takes time: a third less to compile than with -O3.
function(gamut_compile_quickly target)
  target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O1>)
endfunction()

# gamut_room(NAME [LEFT rooms it stands on] [DOORS headers for users]) builds libgamut_NAME from every *.cpp in the room's
# folder and its sub-rooms. Doors are patterns of files; they are installed, with all that they include and nothing else.
function(gamut_room name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "LEFT;DOORS")
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*.cpp)
  add_library(gamut_${name} STATIC ${sources})
  add_library(Gamut::${name} ALIAS gamut_${name})
  set_target_properties(gamut_${name} PROPERTIES EXPORT_NAME ${name} POSITION_INDEPENDENT_CODE ON)
  # Sources say "scalars/interval.hpp", programs outside <gamut/scalars/interval.hpp>: both work when installed.
  target_include_directories(gamut_${name} PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>
    $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/gamut>)
  target_compile_features(gamut_${name} PUBLIC cxx_std_20)
  # Error-free transformations in the public headers: whoever compiles them must not contract.
  target_compile_options(gamut_${name} PUBLIC -ffp-contract=off)
  gamut_compile_options(gamut_${name})
  foreach(left ${arg_LEFT})
    target_link_libraries(gamut_${name} PUBLIC gamut_${left})
  endforeach()
  install(TARGETS gamut_${name} EXPORT Gamut-${name} ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})

  foreach(door ${arg_DOORS})
    file(GLOB headers RELATIVE ${PROJECT_SOURCE_DIR} CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/${door})
    if(NOT headers)
      message(FATAL_ERROR "${name} has no header ${door}")
    endif()
    set_property(GLOBAL APPEND PROPERTY GAMUT_DOORS ${headers})
  endforeach()
endfunction()
