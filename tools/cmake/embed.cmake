# Embeds a text file into C++: malus_embed(TARGET_SOURCE out.cpp NAMESPACE a::b VARIABLE kName FILE in).
function(malus_embed)
  cmake_parse_arguments(E "" "TARGET_SOURCE;NAMESPACE;VARIABLE;FILE" "" ${ARGN})
  add_custom_command(OUTPUT ${E_TARGET_SOURCE}
    COMMAND ${CMAKE_COMMAND} -DOUT=${E_TARGET_SOURCE} -DNAMESPACE=${E_NAMESPACE} -DVARIABLE=${E_VARIABLE} -DFILE=${E_FILE}
            -P ${PROJECT_SOURCE_DIR}/tools/cmake/embed_text.cmake
    DEPENDS ${E_FILE} ${PROJECT_SOURCE_DIR}/tools/cmake/embed_text.cmake
            ${PROJECT_SOURCE_DIR}/tools/cmake/embed_text.cpp.in VERBATIM)
endfunction()
