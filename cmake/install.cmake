# What `cmake --install` and `cpack -G DEB` take: the program, its manual page and completion, documents and examples.
include(GNUInstallDirs)

# The program writes its own documents, when it is installed: whichever target was built.
set(documents ${PROJECT_BINARY_DIR}/documents)
install(TARGETS shadowbench RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
install(CODE "execute_process(COMMAND ${PROJECT_BINARY_DIR}/shadowbench documents ${documents} COMMAND_ERROR_IS_FATAL ANY)")
install(FILES ${documents}/shadowbench.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
install(FILES ${documents}/shadowbench.bash DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions RENAME shadowbench)
install(FILES ${documents}/_shadowbench DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/vendor-completions)

install(FILES README.md CHANGELOG.md DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(DIRECTORY docs DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(DIRECTORY scene/library/ DESTINATION ${CMAKE_INSTALL_DOCDIR}/examples/scenes FILES_MATCHING PATTERN "*.toml")
install(DIRECTORY clients DESTINATION ${CMAKE_INSTALL_DOCDIR}/examples PATTERN node_modules EXCLUDE PATTERN built EXCLUDE)

# Our notice, and those of the packages whose code is compiled in, as Debian has them.
set(notices "shadowbench, GPL-3.0-or-later: /usr/share/common-licenses/GPL-3\n")
foreach(package libboost-dev libcgal-dev libcli11-dev glslang-dev libglm-dev libkainjow-mustache-dev node-d3 nlohmann-json3-dev
        spirv-tools libtomlplusplus-dev libxxhash-dev)
  if(EXISTS /usr/share/doc/${package}/copyright)
    file(READ /usr/share/doc/${package}/copyright notice)
    string(APPEND notices "\n==== Compiled in: ${package} ====\n\n${notice}")
  endif()
endforeach()
file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/copyright CONTENT "${notices}" @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/copyright DESTINATION ${CMAKE_INSTALL_DOCDIR})

# The libraries that the program links are found by dpkg-shlibdeps; what it opens and runs while it runs is named here.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_CONTACT "shadowbench <shadowbench@localhost>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "scores real-time shadow techniques against proven ground truth")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_DEPENDS "libosmesa6 | libegl1, povray, gnuplot-nox | gnuplot-qt | gnuplot-x11, librsvg2-bin")  # every run: soft references, charts
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "valgrind, mesa-vulkan-drivers, git")          # counted instructions; costs of shaders; `ci`
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "cmake, g++, ninja-build")                       # `gate --base REVISION` builds one
include(CPack)
