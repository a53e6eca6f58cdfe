# bench/peers/: programs of the comparison with Mesa. The one that draws with it is built only when asked for, as
# bench/peers/run.sh does: nothing else needs EGL.
add_executable(tessera_peer_inputs ${CMAKE_SOURCE_DIR}/bench/peers/make_inputs.cpp
                                   ${CMAKE_SOURCE_DIR}/bench/peers/environment.cpp
                                   ${CMAKE_SOURCE_DIR}/bench/peers/scene.cpp)
target_link_libraries(tessera_peer_inputs PRIVATE tessera_frame)

add_executable(tessera_peer_compare ${CMAKE_SOURCE_DIR}/bench/peers/compare.cpp
                                    ${CMAKE_SOURCE_DIR}/bench/workload/inputs.cpp)
target_link_libraries(tessera_peer_compare PRIVATE tessera_frame)

if(TESSERA_BUILD_TESTS)
  find_package(Python3 REQUIRED COMPONENTS Interpreter)
  add_test(NAME peer_comparison COMMAND Python3::Interpreter ${CMAKE_SOURCE_DIR}/tests/bench/peers/comparison_test.py
                                        ${CMAKE_SOURCE_DIR}/bench/peers/table.py $<TARGET_FILE:tessera_peer_compare>)
endif()

find_package(OpenGL QUIET COMPONENTS OpenGL EGL)
if(TARGET OpenGL::OpenGL AND TARGET OpenGL::EGL)
  add_executable(tessera_peer_gl EXCLUDE_FROM_ALL ${CMAKE_SOURCE_DIR}/bench/peers/gl_main.cpp
                                                  ${CMAKE_SOURCE_DIR}/bench/peers/gl_context.cpp
                                                  ${CMAKE_SOURCE_DIR}/bench/peers/gl_deferred.cpp
                                                  ${CMAKE_SOURCE_DIR}/bench/workload/inputs.cpp)
  target_link_libraries(tessera_peer_gl PRIVATE tessera_frame OpenGL::OpenGL OpenGL::EGL)
endif()
