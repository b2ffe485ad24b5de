# Our own code is clean under these, as errors; third-party headers come in as system headers. GCC 12 sees moves of an
# optional string out of bounds that are not (array-bounds, stringop); the sanitizers find real ones.
set(SHADOWBENCH_WARNINGS -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion -Wno-array-bounds -Wno-stringop-overread -Werror)
if(NOT CMAKE_CXX_COMPILER_ID STREQUAL GNU)  # the preset `fuzz`: clang does not know all of these, and tools/lint has its own
  set(SHADOWBENCH_WARNINGS -w)
endif()
