# Installed files, in two components. `runtime`: the command, its image modules, its viewer, the scripts of its reports and its
# completion for bash. `development`: the libraries malus::pack (reader and writer of scene packs) and malus::optics
# (headers), for find_package(malus).
include(CMakePackageConfigHelpers)

install(TARGETS malus RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT runtime)
install(TARGETS malus_image_module malus_formats_module LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}/malus COMPONENT runtime)
if(MALUS_VIEWER)
  install(TARGETS malus_viewer_module LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}/malus COMPONENT runtime)
endif()
install(DIRECTORY tools/report DESTINATION ${CMAKE_INSTALL_DATADIR}/malus COMPONENT runtime
  PATTERN "__pycache__" EXCLUDE)
install(FILES ${PROJECT_BINARY_DIR}/${CMAKE_INSTALL_DATADIR}/bash-completion/completions/malus
  DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions COMPONENT runtime)

# The public headers. A header FOLDER/SUBFOLDER/NAME.h is installed as include/malus/SUBFOLDER/NAME.h, and its #include
# lines are changed accordingly. It may include only headers of this list: the installation fails otherwise.
set(MALUS_PUBLIC_HEADERS
  bake/pack/encodings.h
  bake/pack/format.h
  bake/pack/material_kinds.def
  bake/pack/material_kinds.h
  bake/pack/reader.h
  bake/pack/scene.h
  bake/pack/texel_storage.h
  bake/pack/writer.h
  meshprep/base/error.h
  meshprep/compress/bounds.h
  meshprep/compress/deviation.h
  meshprep/compress/draco_mesh.h
  meshprep/compress/rounding.h
  meshprep/compress/texture_rounding.h
  shaders/optics/*.h)
install(CODE "
  set(headers \"${MALUS_PUBLIC_HEADERS}\")
  set(source \"${PROJECT_SOURCE_DIR}\")
  set(staging \"${PROJECT_BINARY_DIR}/public-headers\")
  set(destination \"\${CMAKE_INSTALL_PREFIX}/${CMAKE_INSTALL_INCLUDEDIR}\")" COMPONENT development)
install(SCRIPT tools/cmake/install_headers.cmake COMPONENT development)
install(FILES bake/FORMAT.md shaders/optics/CONVENTIONS.md DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT development)

foreach(name IN ITEMS base compress pack optics)
  set_target_properties(malus_${name} PROPERTIES EXPORT_NAME ${name})
endforeach()
install(TARGETS malus_base malus_compress malus_pack malus_optics EXPORT malusTargets
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development)

set(malus_cmake_dir ${CMAKE_INSTALL_LIBDIR}/cmake/malus)
install(EXPORT malusTargets NAMESPACE malus:: DESTINATION ${malus_cmake_dir} COMPONENT development)
configure_package_config_file(tools/cmake/malusConfig.cmake.in ${PROJECT_BINARY_DIR}/malusConfig.cmake
  INSTALL_DESTINATION ${malus_cmake_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/malusConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/malusConfig.cmake ${PROJECT_BINARY_DIR}/malusConfigVersion.cmake
  DESTINATION ${malus_cmake_dir} COMPONENT development)
