# embed(target name root files): puts text files into the program, as
#   namespace shadowbench::embedded { std::span<const File> <name>(); }   // declared in the generated embedded_<name>.h
# where File is {path relative to root, text}.
function(embed target name root files)
  set(out ${CMAKE_CURRENT_BINARY_DIR}/embedded)
  cmake_path(ABSOLUTE_PATH root BASE_DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR})
  add_custom_command(
    OUTPUT ${out}/embedded_${name}.cpp ${out}/embedded_${name}.h
    COMMAND ${CMAKE_COMMAND} -DNAME=${name} -DROOT=${root} -DOUT=${out} "-DFILES=${files}"
            -P ${CMAKE_CURRENT_SOURCE_DIR}/cmake/embed_files.cmake
    DEPENDS ${files} ${CMAKE_CURRENT_SOURCE_DIR}/cmake/embed_files.cmake
    VERBATIM)
  target_sources(${target} PRIVATE ${out}/embedded_${name}.cpp ${out}/embedded_${name}.h)
  target_include_directories(${target} PRIVATE ${out})
endfunction()
