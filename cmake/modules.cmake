# shadowbench_modules(file): a static library for each line of the file, `folder: folders it includes | packages it links`.
# Its sources are those of the folder that no deeper folder of the file holds. Folders become target names: harness/cells is
# harness_cells. tests/tree/layers_test.cpp holds every include to the same file.

# For code whose time decides no figure: what compiles fastest. GCC misjudges what is initialised where it optimises so little.
set(SHADOWBENCH_COMPILE_FAST $<$<CONFIG:Release>:-Og> -Wno-maybe-uninitialized)

# Headers that many files of a module include, compiled once: pch_common for all, pch_<package> for the modules that link it.
function(shadowbench_precompiled name)
  add_library(pch_${name} OBJECT ${PROJECT_SOURCE_DIR}/cmake/precompiled.cpp)
  set_source_files_properties(${PROJECT_SOURCE_DIR}/cmake/precompiled.cpp PROPERTIES
    COMPILE_OPTIONS $<$<CONFIG:Release>:-O1>)  # nothing of it runs but what headers initialise
  target_link_libraries(pch_${name} PRIVATE shadowbench_options)
  target_precompile_headers(pch_${name} PRIVATE ${ARGN})
endfunction()

# Has the targets take the headers of pch_<name>.
function(shadowbench_precompile name)
  if(SHADOWBENCH_PRECOMPILE)
    foreach(target IN LISTS ARGN)
      target_precompile_headers(${target} REUSE_FROM pch_${name})
    endforeach()
  endif()
endfunction()

# The library `target` of `sources`. Those that see CGAL are compiled apart.
function(shadowbench_library target pch sources)
  set(plain ${sources})
  if(pch STREQUAL cgal)
    set(pch common)
    set(exact "")
    foreach(source IN LISTS sources)
      file(STRINGS ${source} seen REGEX "#include (<CGAL/|\"groundtruth/cgal/geometry/arithmetic.h\"|\"groundtruth/cgal/plan/shadow_polygons_(region|plane).h\")")
      if(seen)
        list(APPEND exact ${source})
        list(REMOVE_ITEM plain ${source})
      endif()
    endforeach()
    add_library(${target}_exact OBJECT ${exact})
    target_link_libraries(${target}_exact PRIVATE shadowbench_options CGAL::CGAL)
    set_property(TARGET ${target}_exact PROPERTY JOB_POOL_COMPILE cgal)
    if(SHADOWBENCH_PRECOMPILE)
      set_target_properties(${target}_exact PROPERTIES UNITY_BUILD ON)
    endif()
    list(APPEND plain $<TARGET_OBJECTS:${target}_exact>)
  endif()
  add_library(${target} STATIC ${plain})
  target_link_libraries(${target} PUBLIC shadowbench_options)
  if(target MATCHES "^(base|scene_(exchange|load)|groundtruth_(contract|store|certify|povray)|techniques_folder|harness_(cells|foreign|inspect|records|runs)|report|studies|gate|history|site|cli)")
    target_compile_options(${target} PRIVATE ${SHADOWBENCH_COMPILE_FAST})
  endif()
  shadowbench_counted(${target} ${target} counted)
  if(SHADOWBENCH_PRECOMPILE AND NOT counted)
    target_precompile_headers(${target} REUSE_FROM pch_${pch})
    # Most of a compilation is headers and their templates, which files together need once.
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 8)
  endif()
endfunction()

# Has `target` count what runs of its lines and branches where SHADOWBENCH_COVERAGE names `module`, a library; sets `counted`
# to whether it does. Unoptimised, so that each branch of the source is one of the program.
function(shadowbench_counted target module counted)
  set(${counted} OFF PARENT_SCOPE)
  if(module IN_LIST SHADOWBENCH_COVERAGE)
    target_compile_options(${target} PRIVATE -O0 --coverage -fprofile-update=atomic)
    target_link_options(${target} PUBLIC --coverage)
    set(${counted} ON PARENT_SCOPE)
  endif()
endfunction()

function(shadowbench_modules file)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${file})
  file(STRINGS ${file} lines REGEX "^[^#]")
  list(TRANSFORM lines REPLACE ":.*" "" OUTPUT_VARIABLE folders)
  foreach(line IN LISTS lines)
    string(REGEX MATCH "^([^:]+):([^|]*)\\|?(.*)$" _ "${line}")
    set(folder ${CMAKE_MATCH_1})
    separate_arguments(arrows UNIX_COMMAND "${CMAKE_MATCH_2}")
    separate_arguments(packages UNIX_COMMAND "${CMAKE_MATCH_3}")

    file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${folder}/*.cpp)
    foreach(deeper IN LISTS folders)
      if(deeper MATCHES "^${folder}/")
        list(FILTER sources EXCLUDE REGEX "^${PROJECT_SOURCE_DIR}/${deeper}/")
      endif()
    endforeach()
    list(FILTER sources EXCLUDE REGEX "/main\\.cpp$")

    set(pch common)
    foreach(package cli11 json cgal)
      if(package IN_LIST packages)
        set(pch ${package})
        break()
      endif()
    endforeach()
    string(REPLACE "/" "_" target ${folder})
    shadowbench_library(${target} ${pch} "${sources}")
    list(TRANSFORM arrows REPLACE "/" "_")
    target_link_libraries(${target} PUBLIC ${arrows})
    foreach(package IN LISTS packages)
      target_link_libraries(${target} PRIVATE ${SHADOWBENCH_PACKAGE_${package}})
    endforeach()
  endforeach()
endfunction()
