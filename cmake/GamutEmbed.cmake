# gamut_embed(TARGET NAMESPACE name FILES text files NAMES what they are called there): the target gets a source in which
# each file is a std::string_view (embed.cmake).
set(GAMUT_EMBED ${CMAKE_CURRENT_LIST_DIR}/embed.cmake)
function(gamut_embed target)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "NAMESPACE" "NAMES;FILES")
  set(output ${CMAKE_CURRENT_BINARY_DIR}/embedded.cpp)
  add_custom_command(
    OUTPUT ${output}
    COMMAND ${CMAKE_COMMAND} -DOUTPUT=${output} -DNAMESPACE=${arg_NAMESPACE} "-DNAMES=${arg_NAMES}" "-DFILES=${arg_FILES}"
            -P ${GAMUT_EMBED}
    DEPENDS ${GAMUT_EMBED} ${arg_FILES}
    COMMENT "Embedding ${arg_NAMES}"
    VERBATIM)
  target_sources(${target} PRIVATE ${output})
endfunction()
