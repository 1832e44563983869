# cmake -DBUILD=... -DSOURCE=... -P check.cmake
#
# 1. Installs the build tree, moves the result, and runs `malus` there.
# 2. Builds and installs the component `development` from a copy of the sources, moves the copy with its build tree
#    away, and builds and runs an outside project with the installed package.
set(work ${BUILD}/installed-package)
file(REMOVE_RECURSE ${work})
file(MAKE_DIRECTORY ${work})

function(step name)
  cmake_parse_arguments(S "" "" "COMMAND;EXPECT" ${ARGN})
  execute_process(COMMAND ${S_COMMAND} RESULT_VARIABLE code OUTPUT_VARIABLE output ERROR_VARIABLE errors
    WORKING_DIRECTORY ${work})
  if(NOT code EQUAL 0)
    message(FATAL_ERROR "${name} ended with ${code}\n${output}\n${errors}")
  endif()
  foreach(expected IN LISTS S_EXPECT)
    string(FIND "${output}" "${expected}" at)
    if(at EQUAL -1)
      message(FATAL_ERROR "${name} did not print '${expected}' but\n${output}")
    endif()
  endforeach()
  message(STATUS "${name}: ok")
endfunction()

function(expect_files)
  foreach(file IN LISTS ARGN)
    if(NOT EXISTS ${file})
      message(FATAL_ERROR "${file} is missing")
    endif()
  endforeach()
endfunction()

step(install COMMAND ${CMAKE_COMMAND} --install ${BUILD} --prefix ${work}/first)
file(RENAME ${work}/first ${work}/prefix)
set(malus ${work}/prefix/${BINDIR}/malus)
expect_files(${work}/prefix/share/malus/report/compare_report.py
  ${work}/prefix/share/bash-completion/completions/malus)

# A release build contains no path of the source or build tree; debug information does.
if(BUILD_TYPE STREQUAL Release)
  file(READ ${malus} binary HEX)
  foreach(path IN ITEMS ${SOURCE} ${BUILD})
    string(HEX "${path}/" hex)
    string(FIND "${binary}" "${hex}" at)
    if(NOT at EQUAL -1)
      message(FATAL_ERROR "${malus} contains the path ${path}/")
    endif()
  endforeach()
endif()

step("malus --version" COMMAND ${malus} --version EXPECT ${VERSION})
step("malus bake" COMMAND ${malus} bake ${SOURCE}/scenes/glass-wall/scene.json -o ${work}/glass-wall.pack
  EXPECT "36 vertices" "28 triangles")
step("malus render" COMMAND ${malus} render ${work}/glass-wall.pack -o ${work}/a.exr -o ${work}/a.png --width 64
  --method stokes EXPECT glass-wall embree stokes)
expect_files(${work}/a.exr ${work}/a.png)

set(options -G ${GENERATOR} -DCMAKE_CXX_COMPILER=${COMPILER} -DCMAKE_BUILD_TYPE=${BUILD_TYPE})
set(stage ${work}/stage)
file(GLOB entries RELATIVE ${SOURCE} ${SOURCE}/*)
list(REMOVE_ITEM entries build scenes tests)
foreach(entry IN LISTS entries)
  file(COPY ${SOURCE}/${entry} DESTINATION ${stage}/source)
endforeach()
step("package: configure" COMMAND ${CMAKE_COMMAND} -S ${stage}/source -B ${stage}/build ${options} -DMALUS_TESTS=OFF
  -DMALUS_SANITIZE=${SANITIZE} -DCMAKE_INSTALL_LIBDIR=lib)
step("package: build" COMMAND ${CMAKE_COMMAND} --build ${stage}/build --target malus_pack)
step("package: install" COMMAND ${CMAKE_COMMAND} --install ${stage}/build --component development --prefix ${work}/package)
file(RENAME ${stage} ${work}/moved-away)

# Public headers, without internal ones.
expect_files(${work}/package/include/malus/pack/writer.h)
foreach(header IN ITEMS base/atomic_file.h base/console.h pack/bytes.h pack/table.h pack/mesh_writer.h)
  if(EXISTS ${work}/package/include/malus/${header})
    message(FATAL_ERROR "${header} is installed; expected public headers only")
  endif()
endforeach()

set(flags "")
if(SANITIZE)
  set(flags -fsanitize=${SANITIZE})
endif()
step("consumer: configure" COMMAND ${CMAKE_COMMAND} -S ${SOURCE}/tests/tools/consumer -B ${work}/consumer ${options}
  -DCMAKE_PREFIX_PATH=${work}/package -DMALUS_INCLUDE=${work}/package/include "-DCMAKE_CXX_FLAGS=${flags}"
  "-DCMAKE_EXE_LINKER_FLAGS=${flags}")
step("consumer: build" COMMAND ${CMAKE_COMMAND} --build ${work}/consumer)
step("consumer: run" COMMAND ${work}/consumer/consumer ${work}/glass-wall.pack ${work}/copy.pack
  EXPECT "R 0.040000" "glass-wall: 5 meshes, 36 vertices" "written: same scene" "error: /no/such.pack")
file(REMOVE_RECURSE ${work})
