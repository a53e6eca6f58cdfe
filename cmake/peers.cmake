# bench/peers/: programs of the comparison with Mesa, built only when asked for (bench/peers/run.sh does).
add_executable(tessera_peer_inputs EXCLUDE_FROM_ALL ${CMAKE_SOURCE_DIR}/bench/peers/make_inputs.cpp
                                                    ${CMAKE_SOURCE_DIR}/bench/peers/scene.cpp)
target_link_libraries(tessera_peer_inputs PRIVATE tessera_frame)

add_executable(tessera_peer_compare EXCLUDE_FROM_ALL ${CMAKE_SOURCE_DIR}/bench/peers/compare.cpp
                                                     ${CMAKE_SOURCE_DIR}/bench/workload/inputs.cpp)
target_link_libraries(tessera_peer_compare PRIVATE tessera_frame)

find_package(OpenGL QUIET COMPONENTS OpenGL EGL)
if(TARGET OpenGL::OpenGL AND TARGET OpenGL::EGL)
  add_executable(tessera_peer_gl EXCLUDE_FROM_ALL ${CMAKE_SOURCE_DIR}/bench/peers/gl_main.cpp
                                                  ${CMAKE_SOURCE_DIR}/bench/peers/gl_context.cpp
                                                  ${CMAKE_SOURCE_DIR}/bench/peers/gl_deferred.cpp
                                                  ${CMAKE_SOURCE_DIR}/bench/workload/inputs.cpp)
  target_link_libraries(tessera_peer_gl PRIVATE tessera_frame OpenGL::OpenGL OpenGL::EGL)
endif()
