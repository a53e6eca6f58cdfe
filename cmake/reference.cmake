# src/reference/: ground truth in double, for tests, charts and checks. It shares no formula with kernels/ and depends
# on nothing but the C++ library.
file(GLOB_RECURSE TESSERA_REFERENCE_SOURCES CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/src/reference/*.cpp)
if(TESSERA_REFERENCE_SOURCES)
  add_library(tessera_reference STATIC ${TESSERA_REFERENCE_SOURCES})
  target_link_libraries(tessera_reference PUBLIC tessera_flags)
endif()

# src/catalogue/: what methods there are, as data. Tests and charts read it.
file(GLOB TESSERA_CATALOGUE_SOURCES CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/src/catalogue/*.cpp)
add_library(tessera_catalogue STATIC ${TESSERA_CATALOGUE_SOURCES})
target_link_libraries(tessera_catalogue PUBLIC tessera_flags)
