# cmake --install: the command, the Python tools, our decks, studies and golden results, the
# documentation.
if(TARGET sluice)  # a build of single rooms has no command to install
  install(TARGETS sluice RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
  # Completion of shells and the man page, written by the command from its own options.
  install(CODE "
    function(write_by_sluice file)
      set(path \$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/\${file})
      cmake_path(GET path PARENT_PATH folder)
      file(MAKE_DIRECTORY \${folder})
      execute_process(COMMAND $<TARGET_FILE:sluice> help \${ARGN} OUTPUT_FILE \${path}
        COMMAND_ERROR_IS_FATAL ANY)
      message(STATUS \"Installing: \${path}\")
    endfunction()
    write_by_sluice(${CMAKE_INSTALL_DATADIR}/bash-completion/completions/sluice --completion bash)
    write_by_sluice(${CMAKE_INSTALL_DATADIR}/zsh/vendor-completions/_sluice --completion zsh)
    write_by_sluice(${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d/sluice.fish
      --completion fish)
    write_by_sluice(${CMAKE_INSTALL_MANDIR}/man1/sluice.1 --man)")
endif()
install(DIRECTORY ${CMAKE_SOURCE_DIR}/tools/sluice_tools
  DESTINATION ${CMAKE_INSTALL_DATADIR}/sluice/tools
  PATTERN "__pycache__" EXCLUDE PATTERN "test_*" EXCLUDE)
install(FILES ${CMAKE_SOURCE_DIR}/tools/pyproject.toml  # for pip install
  DESTINATION ${CMAKE_INSTALL_DATADIR}/sluice/tools)
install(DIRECTORY ${CMAKE_SOURCE_DIR}/inputs DESTINATION ${CMAKE_INSTALL_DATADIR}/sluice)
install(DIRECTORY ${CMAKE_SOURCE_DIR}/regression/accuracy
  DESTINATION ${CMAKE_INSTALL_DATADIR}/sluice/regression FILES_MATCHING PATTERN "*.study")
install(DIRECTORY ${CMAKE_SOURCE_DIR}/regression/stability
  DESTINATION ${CMAKE_INSTALL_DATADIR}/sluice/regression)
install(DIRECTORY ${CMAKE_SOURCE_DIR}/regression/golden
  DESTINATION ${CMAKE_INSTALL_DATADIR}/sluice/regression
  FILES_MATCHING PATTERN "*.json" PATTERN "*.csv")
install(DIRECTORY ${CMAKE_SOURCE_DIR}/docs/ DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/sluice)
install(FILES ${CMAKE_SOURCE_DIR}/README.md ${CMAKE_SOURCE_DIR}/LICENSE
  ${CMAKE_SOURCE_DIR}/CHANGELOG.md DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/sluice)

# cpack -G DEB: a package for Debian 12; dpkg-shlibdeps finds the libraries that it depends on.
set(CPACK_PACKAGE_NAME sluice)
set(CPACK_PACKAGE_CONTACT "Sluice developers <sluice@localhost>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY ${PROJECT_DESCRIPTION})
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_GENERATOR DEB)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_DEPENDS
  "openmpi-bin, python3, python3-numpy, python3-h5py, python3-matplotlib")
include(CPack)
