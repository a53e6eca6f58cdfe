# tests/ mirrors kernels/ and src/. Kernel tests need only the kernels; the others link the whole library.
if(CMAKE_CROSSCOMPILING)
  # The installed library is for this machine; Debian has its source beside it.
  find_path(GOOGLETEST_SOURCE_DIR googletest/CMakeLists.txt PATHS /usr/src/googletest NO_CMAKE_FIND_ROOT_PATH REQUIRED)
  add_subdirectory(${GOOGLETEST_SOURCE_DIR} ${CMAKE_BINARY_DIR}/googletest EXCLUDE_FROM_ALL)
else()
  find_package(GTest REQUIRED)
endif()
include(GoogleTest)

file(GLOB_RECURSE TESSERA_KERNEL_TESTS CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/tests/kernels/*.cpp
                                                      ${CMAKE_SOURCE_DIR}/tests/stability/*.cpp)
# tests/kernels/isa/*.cpp let a test reach what only a kernel can: they are compiled once per instruction set.
file(GLOB TESSERA_ISA_TESTS CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/tests/kernels/isa/*.cpp)
list(FILTER TESSERA_KERNEL_TESTS EXCLUDE REGEX "/tests/kernels/isa/")
if(TESSERA_KERNEL_TESTS)
  add_executable(kernel_tests ${TESSERA_KERNEL_TESTS})
  target_include_directories(kernel_tests PRIVATE ${CMAKE_SOURCE_DIR}/tests)
  target_include_directories(kernel_tests SYSTEM PRIVATE ${XSIMD_INCLUDE_DIR})
  # Tests that evaluate kernel templates in double get the baseline instruction set, which every machine here has.
  target_compile_options(kernel_tests PRIVATE ${TESSERA_FLAGS_${TESSERA_BASELINE_ISA}} ${TESSERA_ONE_THREAD_FLAGS})
  target_link_libraries(kernel_tests PRIVATE tessera_flags tessera_kernels tessera_precise tessera_catalogue
                        GTest::gtest_main
                        $<TARGET_NAME_IF_EXISTS:tessera_reference>)
  foreach(isa IN LISTS TESSERA_ISAS)
    add_library(kernel_tests_${isa} OBJECT ${TESSERA_ISA_TESTS})
    tessera_compile_for_isa(kernel_tests_${isa} ${isa})
    target_compile_options(kernel_tests_${isa} PRIVATE ${TESSERA_ONE_THREAD_FLAGS})
    target_include_directories(kernel_tests_${isa} PRIVATE ${CMAKE_SOURCE_DIR}/tests)
    target_sources(kernel_tests PRIVATE $<TARGET_OBJECTS:kernel_tests_${isa}>)
  endforeach()
  gtest_discover_tests(kernel_tests DISCOVERY_TIMEOUT 60 PROPERTIES TIMEOUT 600)
endif()

# Random bit patterns: a million per kernel in every run, a thousand million with `ctest -L long`.
file(GLOB TESSERA_FUZZ_TESTS CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/tests/fuzz/*.cpp)
add_executable(fuzz_tests ${TESSERA_FUZZ_TESTS} ${CMAKE_SOURCE_DIR}/tests/kernels/shade/shade_scene.cpp)
target_include_directories(fuzz_tests PRIVATE ${CMAKE_SOURCE_DIR}/tests)
target_compile_options(fuzz_tests PRIVATE ${TESSERA_ONE_THREAD_FLAGS})
target_link_libraries(fuzz_tests PRIVATE tessera_flags tessera_kernels tessera_precise tessera_catalogue
                      tessera_reference GTest::gtest_main)
gtest_discover_tests(fuzz_tests DISCOVERY_TIMEOUT 60 PROPERTIES TIMEOUT 600)
gtest_discover_tests(fuzz_tests DISCOVERY_TIMEOUT 60 TEST_PREFIX long. TEST_LIST long_fuzz_tests
                     PROPERTIES TIMEOUT 36000 LABELS long ENVIRONMENT TESSERA_FUZZ_COUNT=1000000000)

if(NOT TESSERA_KERNELS_ONLY)
  file(GLOB_RECURSE TESSERA_CORE_TESTS CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/tests/src/*.cpp ${CMAKE_SOURCE_DIR}/tests/golden/*.cpp)
  if(TESSERA_CORE_TESTS)
    add_executable(core_tests ${TESSERA_CORE_TESTS})
    target_include_directories(core_tests PRIVATE ${CMAKE_SOURCE_DIR}/tests)
    target_link_libraries(core_tests PRIVATE tessera_core tessera_precise $<TARGET_NAME_IF_EXISTS:tessera_reference> GTest::gtest_main)
    target_compile_definitions(core_tests PRIVATE TESSERA_SOURCE_DIR="${CMAKE_SOURCE_DIR}")
    if(TARGET tessera)
      target_compile_definitions(core_tests PRIVATE TESSERA_PROGRAM="$<TARGET_FILE:tessera>")
      add_dependencies(core_tests tessera)
    endif()
    gtest_discover_tests(core_tests DISCOVERY_TIMEOUT 60 PROPERTIES TIMEOUT 600)
  endif()
endif()

# tests/allocation/: with an operator new of its own, that counts.
if(NOT TESSERA_KERNELS_ONLY)
  add_executable(allocation_tests ${CMAKE_SOURCE_DIR}/tests/allocation/steady_state_test.cpp
                                  ${CMAKE_SOURCE_DIR}/tests/golden/scenes.cpp)
  target_include_directories(allocation_tests PRIVATE ${CMAKE_SOURCE_DIR}/tests)
  target_link_libraries(allocation_tests PRIVATE tessera_frame GTest::gtest_main)
  gtest_discover_tests(allocation_tests DISCOVERY_TIMEOUT 60 PROPERTIES TIMEOUT 600)
endif()

# tests/bench/chart/: what draws and writes charts, on synthetic results; and the page in a real browser.
if(TARGET tessera_charts)
  file(GLOB TESSERA_CHART_TESTS CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/tests/bench/chart/*_test.cpp)
  if(NOT TARGET tessera_chart)  # it needs Google Benchmark
    list(FILTER TESSERA_CHART_TESTS EXCLUDE REGEX "/program_test.cpp$")
  endif()
  add_executable(chart_tests ${TESSERA_CHART_TESTS})
  target_include_directories(chart_tests PRIVATE ${CMAKE_SOURCE_DIR}/tests ${CMAKE_SOURCE_DIR}/tests/bench/chart)
  target_link_libraries(chart_tests PRIVATE tessera_charts GTest::gtest_main)
  if(TARGET tessera_chart)
    target_sources(chart_tests PRIVATE ${CMAKE_SOURCE_DIR}/tests/src/cli/program.cpp)
    target_compile_definitions(chart_tests PRIVATE TESSERA_PROGRAM="$<TARGET_FILE:tessera>")
    add_dependencies(chart_tests tessera tessera_chart)
  endif()
  gtest_discover_tests(chart_tests DISCOVERY_TIMEOUT 60 PROPERTIES TIMEOUT 600)
  add_executable(sample_page ${CMAKE_SOURCE_DIR}/tests/bench/chart/sample_page.cpp)
  target_link_libraries(sample_page PRIVATE tessera_charts)
  find_package(Python3 REQUIRED COMPONENTS Interpreter)
  add_test(NAME chart_page COMMAND Python3::Interpreter ${CMAKE_SOURCE_DIR}/tests/bench/chart/page_test.py
                                   $<TARGET_FILE:sample_page>)
  set_tests_properties(chart_page PROPERTIES SKIP_RETURN_CODE 77 TIMEOUT 300)
endif()
