# Run at every build: writes embedded_commit.h with the project's version, the checked-out commit and hashes of the sources,
# embedded_oracle_sources.h with those of each oracle's and embedded_shader_sources.h with those of what draws and compiles
# shaders, and embedded_reach.h with those of what decides each technique's results, only when they changed.
# Of results/, which is being made anew while the program runs, only the golden references make another program.
cmake_minimum_required(VERSION 3.25)
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

# The hash of all files in folders, and of files whatever they end in, but those that match `without`, and of a text that
# belongs to them: the same wherever and whenever they are built.
function(digest_of result text without)
  set(all "${text}\n")
  foreach(name IN LISTS ARGN)
    if(IS_DIRECTORY ${ROOT}/${name})
      file(GLOB_RECURSE files RELATIVE ${ROOT} ${ROOT}/${name}/*)
    else()
      file(GLOB files RELATIVE ${ROOT} ${ROOT}/${name}.*)
    endif()
    list(FILTER files EXCLUDE REGEX "${without}")
    list(SORT files)
    foreach(file IN LISTS files)
      file(SHA256 ${ROOT}/${file} hash)
      string(APPEND all "${hash} ${file}\n")
    endforeach()
  endforeach()
  string(SHA256 digest "${all}")
  string(SUBSTRING ${digest} 0 32 digest)
  set(${result} ${digest} PARENT_SCOPE)
endfunction()
set(beside "") # what is built in or decides how, and lies in none of the folders
foreach(file CMakeLists.txt results/reference/lock.json)
  if(EXISTS ${ROOT}/${file})
    file(SHA256 ${ROOT}/${file} hash)
    string(APPEND beside " ${hash}")
  endif()
endforeach()
file(STRINGS ${ROOT}/cmake/layers.txt rooms REGEX "^[^#]")
list(TRANSFORM rooms REPLACE "[/:].*" "")
list(REMOVE_DUPLICATES rooms)
digest_of(program "${COMPILER}${beside}" "^$" ${rooms} cmake)
include(${CMAKE_CURRENT_LIST_DIR}/reach.cmake)
reach(reach)
file(WRITE ${OUT}/embedded_reach.h.new
     "#pragma once\n\nnamespace shadowbench::embedded {\n\n"
     "inline constexpr const char* reach = R\"(${reach})\";\n\n}  // namespace shadowbench::embedded\n")
file(COPY_FILE ${OUT}/embedded_reach.h.new ${OUT}/embedded_reach.h ONLY_IF_DIFFERENT)
digest_of(metric_code "" "^$" harness/cells harness/measure harness/metrics harness/records harness/render)

# The hashes of what decides which pipelines a frame uses, beside the texts of shaders, and of what compiles them, which name what is
# kept of them.
digest_of(drawing "" "\\.(comp|frag|glsl|vert)$" scene techniques gpu/counter gpu/marks gpu/observer gpu/pipeline gpu/spirv gpu/state gpu/wave_passes harness/render studies/shader_cost/frame_pipelines)
digest_of(compiling "" "gpu/(card|model)" gpu)
file(WRITE ${OUT}/embedded_shader_sources.h.new
     "#pragma once\n\nnamespace shadowbench::embedded {\n\n"
     "inline constexpr const char* drawing_sources = \"${drawing}\";\n"
     "inline constexpr const char* compiling_sources = \"${compiling}\";\n\n}  // namespace shadowbench::embedded\n")
file(COPY_FILE ${OUT}/embedded_shader_sources.h.new ${OUT}/embedded_shader_sources.h ONLY_IF_DIFFERENT)

# The hashes of what computes the numbers of a truth, an oracle each, which name entries of the cache. What a scene consists of
# is in the reference's key. A new file of groundtruth/ counts for all oracles until it is named here.
set(decides groundtruth base/random base/image_io scene/camera scene/sky scene/sky_sampler scene/spherical_harmonics)
set(keeps "groundtruth/(store|area_comparison)")
set(samples "groundtruth/(povray|sky_reference|certify/(certificate|honest_renders|sky_certificate))|base/image_io|scene/s")
digest_of(exact "" "${keeps}|${samples}|groundtruth/cgal/(area|plan)" ${decides})
digest_of(plan "" "${keeps}|${samples}|groundtruth/cgal/area" ${decides})
digest_of(area "" "${keeps}|${samples}|groundtruth/cgal/plan" ${decides})
digest_of(sampled "" "${keeps}|groundtruth/cgal/plan" ${decides})
set(oracles "")
foreach(oracle exact plan area sampled)
  string(SUBSTRING ${${oracle}} 0 12 digest)
  string(APPEND oracles "inline constexpr const char* ${oracle}_sources = \"${digest}\";\n")
endforeach()
file(WRITE ${OUT}/embedded_oracle_sources.h.new
     "#pragma once\n\nnamespace shadowbench::embedded {\n\n${oracles}\n}  // namespace shadowbench::embedded\n")
file(COPY_FILE ${OUT}/embedded_oracle_sources.h.new ${OUT}/embedded_oracle_sources.h ONLY_IF_DIFFERENT)

file(WRITE ${OUT}/embedded_commit.h.new "#pragma once\n\nnamespace shadowbench::embedded {\n\n"
     "inline constexpr const char* version = \"${VERSION}\";\n"
     "inline constexpr const char* commit = \"${commit}\";\ninline constexpr bool dirty = ${dirty};\n"
     "inline constexpr const char* program = \"${program}\";\n"
     "inline constexpr const char* metric_code = \"${metric_code}\";\n\n"
     "}  // namespace shadowbench::embedded\n")
file(COPY_FILE ${OUT}/embedded_commit.h.new ${OUT}/embedded_commit.h ONLY_IF_DIFFERENT)
