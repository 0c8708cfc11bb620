# gamut_types(TARGET Kind FOLDER Base FIRST names) gives the target the source of kindTypes(), the list of all types in a
# sub-room: of each file NAME.cpp there what its nameKind() makes, a Base. The first are listed in this order, any others
# behind them.
function(gamut_types target kind folder base)
  cmake_parse_arguments(PARSE_ARGV 4 arg "" "" "FIRST")
  file(GLOB names RELATIVE ${CMAKE_CURRENT_SOURCE_DIR}/${folder} CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/${folder}/*.cpp)
  list(TRANSFORM names REPLACE "\\.cpp$" "")
  list(REMOVE_ITEM names ${arg_FIRST})
  set(makers ${arg_FIRST} ${names})
  list(TRANSFORM makers APPEND ${kind})
  string(TOLOWER ${kind} header)
  set(declarations "")
  foreach(maker ${makers})
    string(APPEND declarations "std::unique_ptr<${base}> ${maker}();\n")
  endforeach()
  list(JOIN makers ", " makers)
  set(output ${CMAKE_CURRENT_BINARY_DIR}/${folder}/all.cpp)
  file(CONFIGURE OUTPUT ${output} @ONLY CONTENT "#include \"${target}/${header}.hpp\"

namespace gamut {
${declarations}
std::vector<${kind}Type> ${header}Types() { return {${makers}}; }

}  // namespace gamut
")
  target_sources(gamut_${target} PRIVATE ${output})
endfunction()
