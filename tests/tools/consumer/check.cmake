# cmake -DBUILD=... -DSOURCE=... -P check.cmake: installs the build tree to a folder of its own, builds the
# consumer against that, and runs both where the build tree's paths are of no use.
set(work ${BUILD}/installed-package)
file(REMOVE_RECURSE ${work})
file(MAKE_DIRECTORY ${work})

function(step name)
  cmake_parse_arguments(S "" "OUTPUT" "COMMAND;EXPECT" ${ARGN})
  execute_process(COMMAND ${S_COMMAND} RESULT_VARIABLE code OUTPUT_VARIABLE output ERROR_VARIABLE errors
    WORKING_DIRECTORY ${work})
  if(NOT code EQUAL 0)
    message(FATAL_ERROR "${name} ended with ${code}\n${output}\n${errors}")
  endif()
  foreach(expected IN LISTS S_EXPECT)
    string(FIND "${output}" "${expected}" at)
    if(at EQUAL -1)
      message(FATAL_ERROR "${name} did not say '${expected}' but\n${output}")
    endif()
  endforeach()
  message(STATUS "${name}: ok")
endfunction()

step(install COMMAND ${CMAKE_COMMAND} --install ${BUILD} --prefix ${work}/first)

# What was installed can be moved.
file(RENAME ${work}/first ${work}/prefix)
set(malus ${work}/prefix/${BINDIR}/malus)

# No path of the source or the build tree in what runs; assertions and debug information hold some on purpose.
if(BUILD_TYPE STREQUAL Release)
  file(READ ${malus} binary HEX)
  foreach(path IN ITEMS ${SOURCE} ${BUILD})
    string(HEX "${path}/" hex)
    string(FIND "${binary}" "${hex}" at)
    if(NOT at EQUAL -1)
      message(FATAL_ERROR "${malus} holds the path ${path}/")
    endif()
  endforeach()
endif()

step("malus --version" COMMAND ${malus} --version EXPECT "malus ${VERSION}")
step("malus bake" COMMAND ${malus} bake ${SOURCE}/scenes/glass-wall/scene.json -o ${work}/glass-wall.pack
  EXPECT "36 vertices, 28 triangles")
step("malus render" COMMAND ${malus} render ${work}/glass-wall.pack -o ${work}/a.exr -o ${work}/a.png --width 64
  --method stokes EXPECT "glass-wall: embree stokes")
foreach(picture IN ITEMS a.exr a.png)
  if(NOT EXISTS ${work}/${picture})
    message(FATAL_ERROR "malus render left no ${picture}")
  endif()
endforeach()

set(flags "")
if(SANITIZE)
  set(flags -fsanitize=${SANITIZE})
endif()
step("consumer: configure" COMMAND ${CMAKE_COMMAND} -S ${SOURCE}/tests/tools/consumer -B ${work}/consumer -G ${GENERATOR}
  -DCMAKE_PREFIX_PATH=${work}/prefix -DCMAKE_CXX_COMPILER=${COMPILER} "-DCMAKE_CXX_FLAGS=${flags}"
  "-DCMAKE_EXE_LINKER_FLAGS=${flags}")
step("consumer: build" COMMAND ${CMAKE_COMMAND} --build ${work}/consumer)
step("consumer: run" COMMAND ${work}/consumer/consumer ${work}/glass-wall.pack
  EXPECT "R 0.040000" "glass-wall: 5 meshes, 36 vertices")
file(REMOVE_RECURSE ${work})
