# cmake --install: the command, the Python tools, our decks, studies and golden results, the
# documentation.
if(TARGET sluice)  # a build of single rooms has no command to install
  install(TARGETS sluice RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
endif()
install(DIRECTORY ${CMAKE_SOURCE_DIR}/tools/sluice_tools
  DESTINATION ${CMAKE_INSTALL_DATADIR}/sluice/tools
  PATTERN "__pycache__" EXCLUDE PATTERN "test_*" EXCLUDE)
install(FILES ${CMAKE_SOURCE_DIR}/tools/pyproject.toml  # for pip install
  DESTINATION ${CMAKE_INSTALL_DATADIR}/sluice/tools)
install(DIRECTORY ${CMAKE_SOURCE_DIR}/inputs DESTINATION ${CMAKE_INSTALL_DATADIR}/sluice
  FILES_MATCHING PATTERN "*.ups" PATTERN "*.xml")
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
