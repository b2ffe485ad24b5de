# What `cmake --install` and `cpack -G DEB` take: the program, its manual page and its completion, which it writes itself.
include(GNUInstallDirs)

set(documents ${PROJECT_BINARY_DIR}/documents)
add_custom_command(OUTPUT ${documents}/shadowbench.1 ${documents}/shadowbench.bash ${documents}/_shadowbench
  COMMAND shadowbench documents ${documents} DEPENDS shadowbench VERBATIM)
add_custom_target(documents ALL DEPENDS ${documents}/shadowbench.1)

install(TARGETS shadowbench RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
install(FILES ${documents}/shadowbench.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
install(FILES ${documents}/shadowbench.bash DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions RENAME shadowbench)
install(FILES ${documents}/_shadowbench DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/vendor-completions)

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
