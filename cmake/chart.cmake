# bench/chart/: `tessera chart`. tessera_charts draws and writes (tests link it); tessera-chart measures: a program of its
# own, so that `tessera render` loads neither a benchmark nor a drawing library.
find_package(PkgConfig REQUIRED)
pkg_check_modules(RSVG REQUIRED IMPORTED_TARGET librsvg-2.0 cairo)

file(GLOB TESSERA_CHART_SOURCES CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/bench/chart/*.cpp)
set(TESSERA_CHART_FAMILY_SOURCES ${TESSERA_CHART_SOURCES})
list(FILTER TESSERA_CHART_FAMILY_SOURCES INCLUDE REGEX "/family_[a-z]+\\.cpp$")

# The page's parts are files of their own kinds, and strings in the program.
set(TESSERA_CHART_PAGE ${CMAKE_BINARY_DIR}/generated/page_parts.cpp)
set(TESSERA_CHART_PARTS ${CMAKE_SOURCE_DIR}/bench/chart/page.html ${CMAKE_SOURCE_DIR}/bench/chart/page.css
                        ${CMAKE_SOURCE_DIR}/bench/chart/page.js)
add_custom_command(OUTPUT ${TESSERA_CHART_PAGE}
                   COMMAND ${CMAKE_COMMAND} -DOUTPUT=${TESSERA_CHART_PAGE} "-DPARTS=${TESSERA_CHART_PARTS}"
                           -P ${CMAKE_SOURCE_DIR}/cmake/embed.cmake
                   DEPENDS ${TESSERA_CHART_PARTS} ${CMAKE_SOURCE_DIR}/cmake/embed.cmake VERBATIM)

# What draws and writes; the rest measures.
set(TESSERA_CHART_DRAWING
    compare error_map output page page_data page_maps page_table plot plot_frame raster results_read results_write)
list(TRANSFORM TESSERA_CHART_DRAWING REPLACE "(.+)" "${CMAKE_SOURCE_DIR}/bench/chart/\\1.cpp")
add_library(tessera_charts STATIC ${TESSERA_CHART_DRAWING} ${TESSERA_CHART_PAGE})
target_link_libraries(tessera_charts PUBLIC tessera_core PRIVATE PkgConfig::RSVG)

if(TESSERA_BUILD_BENCH)
  find_package(benchmark REQUIRED)
  # families.cpp: one row per family_NAME.cpp, which has measure_NAME.
  set(known fresnel distribution masking diffuse energy function dfg sampling ibl)
  set(names)
  foreach(source IN LISTS TESSERA_CHART_FAMILY_SOURCES)
    string(REGEX REPLACE ".*/family_([a-z]+)\\.cpp$" "\\1" name ${source})
    list(APPEND names ${name})
  endforeach()
  set(ordered ${known} ${names})
  list(REMOVE_DUPLICATES ordered)
  set(TESSERA_CHART_DECLARATIONS)
  set(TESSERA_CHART_ROWS)
  foreach(name IN LISTS ordered)
    if(name IN_LIST names)
      string(APPEND TESSERA_CHART_DECLARATIONS "Family measure_${name}(Session&);\n")
      string(APPEND TESSERA_CHART_ROWS "      {\"${name}\", measure_${name}},\n")
    endif()
  endforeach()
  configure_file(${CMAKE_SOURCE_DIR}/cmake/families.cpp.in ${CMAKE_BINARY_DIR}/generated/families.cpp @ONLY)

  # loop_counts.cpp: instructions of each term and sampler, counted in this build's own objects.
  find_package(Python3 REQUIRED COMPONENTS Interpreter)
  set(term_objects)
  foreach(isa IN LISTS TESSERA_ISAS)
    list(APPEND term_objects "$<FILTER:$<TARGET_OBJECTS:tessera_kernels_${isa}>,INCLUDE,/(terms_|sampling)>")
  endforeach()
  add_custom_command(OUTPUT ${CMAKE_BINARY_DIR}/generated/loop_counts.cpp
                     COMMAND Python3::Interpreter ${CMAKE_SOURCE_DIR}/bench/chart/instructions.py ${CMAKE_OBJDUMP}
                             ${CMAKE_BINARY_DIR}/generated/loop_counts.cpp ${term_objects}
                     DEPENDS ${CMAKE_SOURCE_DIR}/bench/chart/instructions.py ${term_objects}
                     COMMAND_EXPAND_LISTS VERBATIM)

  # The commit is looked up in every build, and the header touched only when it changed.
  add_custom_target(tessera_commit BYPRODUCTS ${CMAKE_BINARY_DIR}/generated/tessera_commit.hpp
                    COMMAND ${CMAKE_COMMAND} -DSOURCE_DIR=${CMAKE_SOURCE_DIR}
                            -DOUTPUT=${CMAKE_BINARY_DIR}/generated/tessera_commit.hpp
                            -P ${CMAKE_SOURCE_DIR}/cmake/commit.cmake VERBATIM)

  string(TOUPPER "${CMAKE_BUILD_TYPE}" build_type)
  get_target_property(contract tessera_flags INTERFACE_COMPILE_OPTIONS)
  list(FILTER contract INCLUDE REGEX "^-f")
  list(JOIN contract " " contract)
  set(TESSERA_CHART_FLAGS "${CMAKE_CXX_FLAGS} ${CMAKE_CXX_FLAGS_${build_type}} ${contract}")
  foreach(isa IN LISTS TESSERA_ISAS)
    list(JOIN TESSERA_FLAGS_${isa} " " flags)
    string(APPEND TESSERA_CHART_FLAGS "; ${isa}: ${flags}")
  endforeach()
  string(STRIP "${TESSERA_CHART_FLAGS}" TESSERA_CHART_FLAGS)
  file(CONFIGURE OUTPUT ${CMAKE_BINARY_DIR}/generated/tessera_chart_flags.hpp @ONLY
       CONTENT "#pragma once\n#define TESSERA_CHART_FLAGS R\"(@TESSERA_CHART_FLAGS@)\"\n")

  list(REMOVE_ITEM TESSERA_CHART_SOURCES ${TESSERA_CHART_DRAWING})
  add_executable(tessera_chart ${TESSERA_CHART_SOURCES} ${CMAKE_BINARY_DIR}/generated/families.cpp
                               ${CMAKE_BINARY_DIR}/generated/loop_counts.cpp ${CMAKE_SOURCE_DIR}/src/cli/help.cpp
                               ${CMAKE_SOURCE_DIR}/src/cli/prefilter_check.cpp ${CMAKE_SOURCE_DIR}/src/cli/text.cpp)
  set_target_properties(tessera_chart PROPERTIES OUTPUT_NAME tessera-chart)
  add_dependencies(tessera_chart tessera_commit)
  target_include_directories(tessera_chart PRIVATE ${CMAKE_BINARY_DIR}/generated)
  target_compile_definitions(tessera_chart PRIVATE TESSERA_VERSION="${PROJECT_VERSION}")
  target_link_libraries(tessera_chart PRIVATE tessera_charts tessera_core tessera_catalogue tessera_precise
                        tessera_reference benchmark::benchmark CLI11::CLI11)
endif()
