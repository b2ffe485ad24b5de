# Run at every build: writes embedded_commit.h with the project's version and the checked-out commit, only when it changed.
execute_process(COMMAND git rev-parse HEAD WORKING_DIRECTORY ${ROOT} OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE
                ERROR_QUIET RESULT_VARIABLE failed)
if(failed)
  set(commit "unknown")
endif()
execute_process(COMMAND git status --porcelain --untracked-files=no WORKING_DIRECTORY ${ROOT} OUTPUT_VARIABLE changes ERROR_QUIET)
if(changes STREQUAL "")
  set(dirty false)
else()
  set(dirty true)
endif()
file(WRITE ${OUT}/embedded_commit.h.new "#pragma once\n\nnamespace shadowbench::embedded {\n\n"
     "inline constexpr const char* version = \"${VERSION}\";\n"
     "inline constexpr const char* commit = \"${commit}\";\ninline constexpr bool dirty = ${dirty};\n\n"
     "}  // namespace shadowbench::embedded\n")
file(COPY_FILE ${OUT}/embedded_commit.h.new ${OUT}/embedded_commit.h ONLY_IF_DIFFERENT)
