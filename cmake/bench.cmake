# bench/: one Google Benchmark program per file.
find_package(benchmark REQUIRED)
file(GLOB TESSERA_BENCHES CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/bench/*_bench.cpp)
foreach(source IN LISTS TESSERA_BENCHES)
  get_filename_component(name ${source} NAME_WE)
  add_executable(${name} ${source})
  target_link_libraries(${name} PRIVATE tessera_core benchmark::benchmark_main)
endforeach()

# The workload that software GPU drivers are timed on.
file(GLOB TESSERA_WORKLOAD_SOURCES CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/bench/workload/*.cpp)
add_executable(tessera_workload ${TESSERA_WORKLOAD_SOURCES})
target_link_libraries(tessera_workload PRIVATE tessera_frame)

# How frames grow with threads, pixels, triangles and lights.
file(GLOB TESSERA_SCALING_SOURCES CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/bench/scaling/*.cpp)
set(TESSERA_SCALED_SOURCES ${TESSERA_WORKLOAD_SOURCES})
list(FILTER TESSERA_SCALED_SOURCES EXCLUDE REGEX "/main\\.cpp$")
add_executable(tessera_scaling ${TESSERA_SCALING_SOURCES} ${TESSERA_SCALED_SOURCES}
                               ${CMAKE_SOURCE_DIR}/bench/peers/environment.cpp ${CMAKE_SOURCE_DIR}/bench/peers/scene.cpp)
target_link_libraries(tessera_scaling PRIVATE tessera_core)

if(TESSERA_BUILD_TESTS)
  set(TESSERA_SCALING_TESTED ${TESSERA_SCALING_SOURCES})
  list(FILTER TESSERA_SCALING_TESTED EXCLUDE REGEX "/main\\.cpp$")
  add_executable(scaling_tests ${CMAKE_SOURCE_DIR}/tests/bench/scaling/scaling_test.cpp ${TESSERA_SCALING_TESTED}
                               ${TESSERA_SCALED_SOURCES} ${CMAKE_SOURCE_DIR}/bench/peers/environment.cpp
                               ${CMAKE_SOURCE_DIR}/bench/peers/scene.cpp)
  target_link_libraries(scaling_tests PRIVATE tessera_core GTest::gtest_main)
  gtest_discover_tests(scaling_tests DISCOVERY_TIMEOUT 60 PROPERTIES TIMEOUT 600)
endif()

# The price of the determinism contract: the kernels that draw a frame once more, with free contraction, in namespaces
# of their own. Built only when asked for.
set(TESSERA_CONTRACTED_ENTRIES)
foreach(entry geometry coverage resolve shade)
  list(APPEND TESSERA_CONTRACTED_ENTRIES ${CMAKE_SOURCE_DIR}/kernels/entry/${entry}.cpp)
endforeach()
add_library(tessera_contraction INTERFACE)
target_compile_options(tessera_contraction INTERFACE -ffp-contract=fast)  # after tessera_flags, which it overrides
set(TESSERA_DETERMINISM_SOURCES ${TESSERA_WORKLOAD_SOURCES})
list(FILTER TESSERA_DETERMINISM_SOURCES INCLUDE REGEX "/(inputs|shade_blocks)\\.cpp$")
add_executable(tessera_determinism EXCLUDE_FROM_ALL
               ${CMAKE_SOURCE_DIR}/bench/determinism/main.cpp ${CMAKE_SOURCE_DIR}/bench/determinism/contracted.cpp
               ${TESSERA_DETERMINISM_SOURCES})
target_link_libraries(tessera_determinism PRIVATE tessera_core)
foreach(isa IN LISTS TESSERA_ISAS)
  if(NOT isa STREQUAL sse42)  # it has no fused multiply-add
    add_library(tessera_contracted_${isa} OBJECT EXCLUDE_FROM_ALL ${TESSERA_CONTRACTED_ENTRIES})
    tessera_compile_for_isa(tessera_contracted_${isa} ${isa} ${isa}_contracted)
    target_link_libraries(tessera_contracted_${isa} PRIVATE tessera_contraction)
    target_sources(tessera_determinism PRIVATE $<TARGET_OBJECTS:tessera_contracted_${isa}>)
  endif()
endforeach()
