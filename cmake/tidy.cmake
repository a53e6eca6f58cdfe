# `cmake --build build/release --target tidy`: clang-tidy over src/ with .clang-tidy. -DTIDY_FILES=REGEX narrows it.
find_program(RUN_CLANG_TIDY NAMES run-clang-tidy run-clang-tidy-14)
set(TIDY_FILES "/src/" CACHE STRING "Which sources the target tidy checks: a regular expression")
if(RUN_CLANG_TIDY)
  add_custom_target(tidy COMMAND ${RUN_CLANG_TIDY} -quiet -p ${CMAKE_BINARY_DIR} ${TIDY_FILES}
                    WORKING_DIRECTORY ${CMAKE_SOURCE_DIR} VERBATIM)
endif()
