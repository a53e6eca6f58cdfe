# Tests that look at the project from outside: its symbols, its #include lines, its bits on another architecture.
file(GLOB TESSERA_HASH_SOURCES CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/tests/guards/kernel_hash*.cpp)
add_executable(kernel_hash ${TESSERA_HASH_SOURCES})
target_include_directories(kernel_hash PRIVATE ${CMAKE_SOURCE_DIR}/tests)
target_link_libraries(kernel_hash PRIVATE tessera_flags tessera_kernels)

if(TESSERA_BUILD_TESTS AND NOT CMAKE_CROSSCOMPILING)
  find_package(Python3 REQUIRED COMPONENTS Interpreter)
  set(TESSERA_KERNEL_OBJECTS)
  foreach(isa IN LISTS TESSERA_ISAS)
    list(APPEND TESSERA_KERNEL_OBJECTS $<TARGET_OBJECTS:tessera_kernels_${isa}>)
  endforeach()
  add_test(NAME symbols COMMAND Python3::Interpreter ${CMAKE_SOURCE_DIR}/tests/guards/symbols.py ${CMAKE_NM}
                                ${TESSERA_KERNEL_OBJECTS} COMMAND_EXPAND_LISTS)
  add_test(NAME includes COMMAND Python3::Interpreter ${CMAKE_SOURCE_DIR}/tests/guards/includes.py ${CMAKE_SOURCE_DIR})
  add_test(NAME aarch64_bits
           COMMAND Python3::Interpreter ${CMAKE_SOURCE_DIR}/tests/guards/aarch64_bits.py ${CMAKE_SOURCE_DIR}
                   ${CMAKE_BINARY_DIR}/aarch64 $<TARGET_FILE:kernel_hash>)
  set_tests_properties(aarch64_bits PROPERTIES LABELS cross SKIP_RETURN_CODE 77 TIMEOUT 1200)
endif()
