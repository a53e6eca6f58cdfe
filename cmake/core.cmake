# src/: the library everything else links, and the command-line program.
#   tessera_frame   base, scene, precompute, raster, frame: arrays in, a film out. Starts in milliseconds.
#   tessera_core    with files: glTF, and pictures through OpenImageIO, which brings 260 shared libraries
find_package(TBB REQUIRED)
find_package(fmt REQUIRED)
# OpenImageIO's own CMake file, in Debian, insists on the programs of openimageio-tools (and so on Qt), on Python's Imath
# and on OpenCV's headers. The library alone is all that Tessera uses.
find_path(OPENIMAGEIO_INCLUDE_DIR OpenImageIO/imageio.h REQUIRED)
find_library(OPENIMAGEIO_LIBRARY OpenImageIO REQUIRED)
find_library(OPENIMAGEIO_UTIL_LIBRARY OpenImageIO_Util REQUIRED)
add_library(tessera_openimageio INTERFACE)
target_include_directories(tessera_openimageio SYSTEM INTERFACE ${OPENIMAGEIO_INCLUDE_DIR})
target_link_libraries(tessera_openimageio INTERFACE ${OPENIMAGEIO_LIBRARY} ${OPENIMAGEIO_UTIL_LIBRARY})
find_package(glm REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(CLI11 REQUIRED)
find_package(TinyGLTF REQUIRED)
find_package(draco REQUIRED)
find_package(meshoptimizer REQUIRED)

file(GLOB_RECURSE TESSERA_CORE_SOURCES CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/src/*.cpp)
set(TESSERA_CLI_SOURCES ${TESSERA_CORE_SOURCES})
list(FILTER TESSERA_CORE_SOURCES EXCLUDE REGEX "/src/(catalogue|cli|reference)/")
list(FILTER TESSERA_CLI_SOURCES INCLUDE REGEX "/src/cli/")

# One of two implementations of base/parallel.hpp.
if(TESSERA_PLAIN_THREADS)
  list(FILTER TESSERA_CORE_SOURCES EXCLUDE REGEX "/src/base/parallel\\.cpp")
else()
  list(FILTER TESSERA_CORE_SOURCES EXCLUDE REGEX "/src/base/parallel_plain\\.cpp")
endif()

set(TESSERA_FRAME_SOURCES ${TESSERA_CORE_SOURCES})
list(FILTER TESSERA_FRAME_SOURCES INCLUDE REGEX "/src/(base|scene|precompute|raster|frame)/")
list(FILTER TESSERA_FRAME_SOURCES EXCLUDE REGEX "_file\\.cpp$")
list(REMOVE_ITEM TESSERA_CORE_SOURCES ${TESSERA_FRAME_SOURCES})

add_library(tessera_frame STATIC ${TESSERA_FRAME_SOURCES})
target_link_libraries(tessera_frame PUBLIC tessera_flags tessera_kernels TBB::tbb fmt::fmt)

add_library(tessera_core STATIC ${TESSERA_CORE_SOURCES})
target_link_libraries(tessera_core PUBLIC tessera_frame tessera_openimageio glm::glm nlohmann_json::nlohmann_json
                      PRIVATE TinyGLTF::TinyGLTF draco::draco meshoptimizer::meshoptimizer)

if(TESSERA_CLI_SOURCES)
  add_executable(tessera ${TESSERA_CLI_SOURCES})
  target_link_libraries(tessera PRIVATE tessera_core tessera_catalogue tessera_reference CLI11::CLI11)
  target_compile_definitions(tessera PRIVATE TESSERA_VERSION="${PROJECT_VERSION}")
endif()
