# What `cmake --install` puts in place: the command, its picture module, and for other projects the optics
# and the pack reader as malus::optics and malus::pack.
include(CMakePackageConfigHelpers)

install(TARGETS malus RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
install(TARGETS malus_image_module LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}/malus)

install(DIRECTORY tools/report DESTINATION ${CMAKE_INSTALL_DATADIR}/malus PATTERN "__pycache__" EXCLUDE)

foreach(name IN ITEMS base compress pack optics)
  set_target_properties(malus_${name} PROPERTIES EXPORT_NAME ${name})
endforeach()
install(TARGETS malus_base malus_compress malus_pack malus_optics EXPORT malusTargets
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(DIRECTORY shaders/optics DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/malus/shaders FILES_MATCHING PATTERN "*.h" PATTERN "*.md")
install(DIRECTORY bake/pack DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/malus/bake
  FILES_MATCHING PATTERN "*.h" PATTERN "*.def")
install(FILES meshprep/base/error.h meshprep/base/atomic_file.h
  DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/malus/meshprep/base)
install(FILES meshprep/compress/draco_mesh.h DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/malus/meshprep/compress)

set(malus_cmake_dir ${CMAKE_INSTALL_LIBDIR}/cmake/malus)
install(EXPORT malusTargets NAMESPACE malus:: DESTINATION ${malus_cmake_dir})
configure_package_config_file(tools/cmake/malusConfig.cmake.in ${PROJECT_BINARY_DIR}/malusConfig.cmake
  INSTALL_DESTINATION ${malus_cmake_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/malusConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/malusConfig.cmake ${PROJECT_BINARY_DIR}/malusConfigVersion.cmake
  DESTINATION ${malus_cmake_dir})
