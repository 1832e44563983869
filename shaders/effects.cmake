# The compiled effects of shaders/effects.def for CMake.

# Sets in the caller's scope: effects, a list of rows macro|build.
function(malus_read_effects)
  set(table ${PROJECT_SOURCE_DIR}/shaders/effects.def)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${table})
  file(STRINGS ${table} rows REGEX "^MALUS_(SOURCE|SURFACE|SHADER)_ROW\\(")
  set(effects "")
  foreach(row IN LISTS rows)
    if(NOT row MATCHES "^MALUS_[A-Z]+_ROW\\([A-Za-z]+, ([A-Z_]+), (plain|lit|every), ")
      message(FATAL_ERROR "${table}: cannot read the row ${row}; expected id, MACRO, plain, lit or every, ...")
    endif()
    list(APPEND effects "${CMAKE_MATCH_1}|${CMAKE_MATCH_2}")
  endforeach()
  set(effects "${effects}" PARENT_SCOPE)
endfunction()
