# Our own code is clean under these, as errors; third-party headers come in as system headers.
set(SHADOWBENCH_WARNINGS -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion -Werror)
