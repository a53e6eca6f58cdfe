# src/: the library everything else links, and the command-line program.
# OpenImageIO's own CMake file, in Debian, insists on the programs of openimageio-tools (and so on Qt), on Python's Imath
# and on OpenCV's headers. The library alone is all that Tessera uses.
find_path(OPENIMAGEIO_INCLUDE_DIR OpenImageIO/imageio.h REQUIRED)
find_library(OPENIMAGEIO_LIBRARY OpenImageIO REQUIRED)
find_library(OPENIMAGEIO_UTIL_LIBRARY OpenImageIO_Util REQUIRED)
add_library(tessera_openimageio INTERFACE)
target_include_directories(tessera_openimageio SYSTEM INTERFACE ${OPENIMAGEIO_INCLUDE_DIR})
target_link_libraries(tessera_openimageio INTERFACE ${OPENIMAGEIO_LIBRARY} ${OPENIMAGEIO_UTIL_LIBRARY})
find_package(TBB REQUIRED)
find_package(fmt REQUIRED)
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

add_library(tessera_core STATIC ${TESSERA_CORE_SOURCES})
target_link_libraries(tessera_core PUBLIC tessera_flags tessera_kernels tessera_openimageio TBB::tbb fmt::fmt
                      glm::glm nlohmann_json::nlohmann_json
                      PRIVATE TinyGLTF::TinyGLTF draco::draco meshoptimizer::meshoptimizer)

if(TESSERA_CLI_SOURCES)
  add_executable(tessera ${TESSERA_CLI_SOURCES})
  target_link_libraries(tessera PRIVATE tessera_core tessera_catalogue tessera_reference CLI11::CLI11)
  target_compile_definitions(tessera PRIVATE TESSERA_VERSION="${PROJECT_VERSION}")
endif()
