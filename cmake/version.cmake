# Run at every build: writes embedded_commit.h with the project's version and the checked-out commit, only when it changed.
# Of results/, which is being made anew while the program runs, only the golden references make another program.
execute_process(COMMAND git rev-parse HEAD WORKING_DIRECTORY ${ROOT} OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE
                ERROR_QUIET RESULT_VARIABLE failed)
if(failed)
  set(commit "unknown")
endif()
set(changed git status --porcelain --untracked-files=no --)
execute_process(COMMAND ${changed} . ":(exclude)results" WORKING_DIRECTORY ${ROOT} OUTPUT_VARIABLE changes ERROR_QUIET)
execute_process(COMMAND ${changed} results/reference WORKING_DIRECTORY ${ROOT} OUTPUT_VARIABLE golden_changes ERROR_QUIET)
if("${changes}${golden_changes}" STREQUAL "")
  set(dirty false)
else()
  set(dirty true)
endif()
file(WRITE ${OUT}/embedded_commit.h.new "#pragma once\n\nnamespace shadowbench::embedded {\n\n"
     "inline constexpr const char* version = \"${VERSION}\";\n"
     "inline constexpr const char* commit = \"${commit}\";\ninline constexpr bool dirty = ${dirty};\n\n"
     "}  // namespace shadowbench::embedded\n")
file(COPY_FILE ${OUT}/embedded_commit.h.new ${OUT}/embedded_commit.h ONLY_IF_DIFFERENT)
