# src/: the library everything else links, and the command-line program.
find_package(OpenImageIO REQUIRED)
# Debian's OpenImageIO names OpenCV's headers, which its -dev package does not depend on and Tessera does not use.
set_target_properties(OpenImageIO::OpenImageIO PROPERTIES INTERFACE_INCLUDE_DIRECTORIES "")
find_package(TBB REQUIRED)
find_package(fmt REQUIRED)
find_package(glm REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(CLI11 REQUIRED)

file(GLOB_RECURSE TESSERA_CORE_SOURCES CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/src/*.cpp)
set(TESSERA_CLI_SOURCES ${TESSERA_CORE_SOURCES})
list(FILTER TESSERA_CORE_SOURCES EXCLUDE REGEX "/src/(cli|reference)/")
list(FILTER TESSERA_CLI_SOURCES INCLUDE REGEX "/src/cli/")

add_library(tessera_core STATIC ${TESSERA_CORE_SOURCES})
target_link_libraries(tessera_core PUBLIC tessera_flags tessera_kernels OpenImageIO::OpenImageIO TBB::tbb fmt::fmt
                      glm::glm nlohmann_json::nlohmann_json)

if(TESSERA_CLI_SOURCES)
  add_executable(tessera ${TESSERA_CLI_SOURCES})
  target_link_libraries(tessera PRIVATE tessera_core CLI11::CLI11)
endif()
