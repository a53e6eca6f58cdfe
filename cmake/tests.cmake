# tests/ mirrors kernels/ and src/. Kernel tests need only the kernels; the others link the whole library.
find_package(GTest REQUIRED)
include(GoogleTest)

file(GLOB_RECURSE TESSERA_KERNEL_TESTS CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/tests/kernels/*.cpp
                                                      ${CMAKE_SOURCE_DIR}/tests/stability/*.cpp)
if(TESSERA_KERNEL_TESTS)
  add_executable(kernel_tests ${TESSERA_KERNEL_TESTS})
  target_include_directories(kernel_tests PRIVATE ${CMAKE_SOURCE_DIR}/tests)
  target_include_directories(kernel_tests SYSTEM PRIVATE ${XSIMD_INCLUDE_DIR})
  # Tests that evaluate kernel templates in double get the baseline instruction set, which every machine here has.
  list(GET TESSERA_ISAS 0 TESSERA_BASELINE_ISA)
  target_compile_options(kernel_tests PRIVATE ${TESSERA_FLAGS_${TESSERA_BASELINE_ISA}})
  target_link_libraries(kernel_tests PRIVATE tessera_flags tessera_kernels GTest::gtest_main
                        $<TARGET_NAME_IF_EXISTS:tessera_reference>)
  gtest_discover_tests(kernel_tests DISCOVERY_TIMEOUT 60 PROPERTIES TIMEOUT 600)
endif()

if(NOT TESSERA_KERNELS_ONLY)
  file(GLOB_RECURSE TESSERA_CORE_TESTS CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/tests/src/*.cpp ${CMAKE_SOURCE_DIR}/tests/golden/*.cpp)
  if(TESSERA_CORE_TESTS)
    add_executable(core_tests ${TESSERA_CORE_TESTS})
    target_include_directories(core_tests PRIVATE ${CMAKE_SOURCE_DIR}/tests)
    target_link_libraries(core_tests PRIVATE tessera_core $<TARGET_NAME_IF_EXISTS:tessera_reference> GTest::gtest_main)
    target_compile_definitions(core_tests PRIVATE TESSERA_SOURCE_DIR="${CMAKE_SOURCE_DIR}")
    if(TARGET tessera)
      target_compile_definitions(core_tests PRIVATE TESSERA_PROGRAM="$<TARGET_FILE:tessera>")
      add_dependencies(core_tests tessera)
    endif()
    gtest_discover_tests(core_tests DISCOVERY_TIMEOUT 60 PROPERTIES TIMEOUT 600)
  endif()
endif()
