# The target docs: the API page, and every other page, in out/api.
set(condyle_api_folder ${PROJECT_SOURCE_DIR}/out/api)
find_package(Doxygen 1.9.1 QUIET)
if(DOXYGEN_FOUND)
  configure_file(${PROJECT_SOURCE_DIR}/docs/Doxyfile.in ${PROJECT_BINARY_DIR}/Doxyfile @ONLY)
  add_custom_target(docs COMMAND ${CMAKE_COMMAND} -E rm -rf ${condyle_api_folder}
                    COMMAND ${CMAKE_COMMAND} -E make_directory ${condyle_api_folder}
                    COMMAND Doxygen::doxygen ${PROJECT_BINARY_DIR}/Doxyfile
                    COMMENT "Making out/api/index.html" VERBATIM)
endif()
