# kernels/entry/*.cpp, each compiled once per instruction set. TESSERA_ISA names the namespace; the flags are all
# that differs. kernels are optimised in Debug too: at -O0 the helpers of xsimd leak as shared symbols.
find_path(XSIMD_SYSTEM_DIR xsimd/xsimd.hpp REQUIRED)
# A folder that holds xsimd and nothing else: a cross compiler must not see the other headers of the machine it runs on.
set(XSIMD_INCLUDE_DIR ${CMAKE_BINARY_DIR}/include)
file(MAKE_DIRECTORY ${XSIMD_INCLUDE_DIR})
file(CREATE_LINK ${XSIMD_SYSTEM_DIR}/xsimd ${XSIMD_INCLUDE_DIR}/xsimd SYMBOLIC)
file(GLOB TESSERA_KERNEL_ENTRIES CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/kernels/entry/*.cpp)

if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
  set(TESSERA_ISAS sse42 avx2 avx512)
  set(TESSERA_FLAGS_sse42 -march=x86-64-v2)
  set(TESSERA_FLAGS_avx2 -march=x86-64-v3)
  set(TESSERA_FLAGS_avx512 -march=x86-64-v4 -mprefer-vector-width=512)
elseif(CMAKE_SYSTEM_PROCESSOR MATCHES "aarch64|arm64")
  set(TESSERA_ISAS neon64)
  set(TESSERA_FLAGS_neon64)
else()
  message(FATAL_ERROR "Tessera has kernels for x86-64 and AArch64, not for ${CMAKE_SYSTEM_PROCESSOR}")
endif()

# Compiles a target as the kernels of one instruction set; in another namespace than the set's name, if one is given.
function(tessera_compile_for_isa target isa)
  set(namespace ${isa} ${ARGN})
  list(GET namespace -1 namespace)
  target_link_libraries(${target} PRIVATE tessera_flags)
  target_include_directories(${target} SYSTEM PRIVATE ${XSIMD_INCLUDE_DIR})
  target_compile_definitions(${target} PRIVATE TESSERA_ISA=${namespace})
  target_compile_options(${target} PRIVATE ${TESSERA_FLAGS_${isa}} -Werror=double-promotion $<$<CONFIG:Debug>:-O1>
                                           -fno-exceptions -fno-rtti)
  # Vectors of vectors (Vec3<Float>: 192 bytes) exceed what GCC splits into registers by default; without this every
  # copy of one goes through the stack.
  target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:--param=sra-max-scalarization-size-Ospeed=4096>)
  # With debug information, following variables through code inlined this deep takes two thirds of the compile time.
  target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-fno-var-tracking>)
endfunction()

# The price of the determinism contract is measured against what the compiler makes of the same templates when it may
# contract a * b + c: this file alone, which only the chart runs (kernels/math/estimate.hpp).
set_source_files_properties(${CMAKE_SOURCE_DIR}/kernels/entry/terms_estimate.cpp PROPERTIES COMPILE_OPTIONS
                                                                                          -ffp-contract=fast)

# Kernels that only charts and tests run, one after another; the renderer's are all the others.
file(GLOB TESSERA_TERM_ENTRIES CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/kernels/entry/terms*.cpp)
set_property(SOURCE ${TESSERA_TERM_ENTRIES} ${CMAKE_SOURCE_DIR}/kernels/entry/sampling.cpp
             APPEND PROPERTY COMPILE_OPTIONS ${TESSERA_ONE_THREAD_FLAGS})

add_library(tessera_kernels STATIC ${CMAKE_SOURCE_DIR}/kernels/tables.cpp ${CMAKE_SOURCE_DIR}/kernels/sampling_tables.cpp)
target_link_libraries(tessera_kernels PRIVATE tessera_flags)
foreach(isa IN LISTS TESSERA_ISAS)
  add_library(tessera_kernels_${isa} OBJECT ${TESSERA_KERNEL_ENTRIES})
  tessera_compile_for_isa(tessera_kernels_${isa} ${isa})
  target_sources(tessera_kernels PRIVATE $<TARGET_OBJECTS:tessera_kernels_${isa}>)
endforeach()

# The terms over double, from the same sources (kernels/terms.hpp); libm is allowed here, for no pixel comes of it.
list(GET TESSERA_ISAS 0 TESSERA_BASELINE_ISA)
add_library(tessera_precise STATIC ${TESSERA_TERM_ENTRIES})
tessera_compile_for_isa(tessera_precise precise)
target_compile_options(tessera_precise PRIVATE ${TESSERA_FLAGS_${TESSERA_BASELINE_ISA}} -Wno-error=double-promotion)
target_compile_definitions(tessera_precise PRIVATE TESSERA_PRECISE)
