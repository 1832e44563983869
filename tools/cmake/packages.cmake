# Every package, and what has to be said about it on Debian 12 and 13.
find_package(Threads REQUIRED)  # glslang's files need it first
find_package(PkgConfig REQUIRED)
pkg_check_modules(xxhash REQUIRED IMPORTED_TARGET libxxhash)
find_package(fmt REQUIRED)
find_package(glm REQUIRED)
find_package(CLI11 REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(TBB REQUIRED)
find_package(OpenMesh REQUIRED)
find_package(draco REQUIRED)
set(CGAL_DO_NOT_WARN_ABOUT_CMAKE_BUILD_TYPE ON)
find_package(CGAL REQUIRED)
find_package(OpenImageIO REQUIRED)
find_package(Vulkan REQUIRED)
find_package(glslang REQUIRED)

# Embree 3 on Debian 12, 4 on Debian 13; render/embree/embree.h hides the difference.
find_package(embree 4 QUIET)
if(NOT embree_FOUND)
  find_package(embree 3 REQUIRED)
endif()

# The header alone: meshprep/read/gltf_library.h says why.
find_path(TINYGLTF_INCLUDE tiny_gltf.h REQUIRED)

# OpenImageIO names an opencv4 include folder that may not be there.
add_library(malus_openimageio INTERFACE)
add_library(malus::openimageio ALIAS malus_openimageio)
get_target_property(oiio_includes OpenImageIO::OpenImageIO INTERFACE_INCLUDE_DIRECTORIES)
set(oiio_kept "")
foreach(folder IN LISTS oiio_includes)
  if(EXISTS "${folder}")
    list(APPEND oiio_kept "${folder}")
  endif()
endforeach()
set_target_properties(OpenImageIO::OpenImageIO PROPERTIES INTERFACE_INCLUDE_DIRECTORIES "${oiio_kept}")
target_link_libraries(malus_openimageio INTERFACE OpenImageIO::OpenImageIO)

if(MALUS_TESTS)
  find_package(GTest REQUIRED)
  include(GoogleTest)
endif()
