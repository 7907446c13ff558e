# What cmake --install places, in parts (components): the command; the libraries with their headers and what finds them; the
# shared library of the C interface; the documentation.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(condyle_cmake_folder ${CMAKE_INSTALL_LIBDIR}/cmake/condyle)

# One file of targets for each component of find_package, so that a user of the core does not have to have HDF5.
function(install_library name component)
  install(TARGETS ${name} EXPORT condyle_${component}
          ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development
          FILE_SET HEADERS DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT development)
  install(EXPORT condyle_${component} NAMESPACE condyle:: FILE condyle-${component}.cmake
          DESTINATION ${condyle_cmake_folder} COMPONENT development)
endfunction()

install_library(condyle core)
install_library(condyle_sample sample)
if(CONDYLE_IO)
  install_library(condyle_io io)
  install(TARGETS condyle_cli RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT command)
endif()
if(CONDYLE_C)
  install(TARGETS condyle_c EXPORT condyle_c
          LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT library NAMELINK_COMPONENT development
          FILE_SET HEADERS DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT development)
  install(EXPORT condyle_c NAMESPACE condyle:: FILE condyle-c.cmake DESTINATION ${condyle_cmake_folder} COMPONENT development)
endif()

configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/condyleConfig.cmake.in
                              ${PROJECT_BINARY_DIR}/cmake/condyleConfig.cmake
                              INSTALL_DESTINATION ${condyle_cmake_folder} NO_SET_AND_CHECK_MACRO)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/cmake/condyleConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/cmake/condyleConfig.cmake ${PROJECT_BINARY_DIR}/cmake/condyleConfigVersion.cmake
        DESTINATION ${condyle_cmake_folder} COMPONENT development)

# They find their prefix from their own place, since cmake --install may be told another than was configured.
set(pc_prefix ${CMAKE_INSTALL_PREFIX})
set(pc_libdir ${CMAKE_INSTALL_LIBDIR})
set(pc_includedir ${CMAKE_INSTALL_INCLUDEDIR})
if(NOT IS_ABSOLUTE "${CMAKE_INSTALL_LIBDIR}")
  file(RELATIVE_PATH up /${CMAKE_INSTALL_LIBDIR}/pkgconfig /)
  set(pc_prefix "\${pcfiledir}/${up}")
  set(pc_libdir "\${prefix}/${CMAKE_INSTALL_LIBDIR}")
endif()
if(NOT IS_ABSOLUTE "${CMAKE_INSTALL_INCLUDEDIR}")
  set(pc_includedir "\${prefix}/${CMAKE_INSTALL_INCLUDEDIR}")
endif()
set(pc_threads "")
if(CONDYLE_THREADS STREQUAL "tbb")
  set(pc_threads "tbb ")
endif()
set(pc_files condyle)
if(CONDYLE_C)
  list(APPEND pc_files condyle-c)
endif()
foreach(pc_file ${pc_files})
  configure_file(${PROJECT_SOURCE_DIR}/cmake/${pc_file}.pc.in ${PROJECT_BINARY_DIR}/cmake/${pc_file}.pc @ONLY)
  install(FILES ${PROJECT_BINARY_DIR}/cmake/${pc_file}.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT development)
endforeach()

# Whoever gets one part gets the licence.
set(condyle_parts command:condyle development:libcondyle-dev documentation:condyle-doc)
if(CONDYLE_PYTHON)
  list(APPEND condyle_parts python:python3-condyle)
endif()
if(CONDYLE_C)
  list(APPEND condyle_parts library:libcondyle1)
endif()
foreach(part ${condyle_parts})
  string(REGEX MATCH "^(.*):(.*)$" matched ${part})
  set(licences ${CMAKE_INSTALL_DATAROOTDIR}/doc/${CMAKE_MATCH_2})
  set(component ${CMAKE_MATCH_1})
  install(FILES ${PROJECT_SOURCE_DIR}/LICENSE ${PROJECT_SOURCE_DIR}/NOTICE DESTINATION ${licences} COMPONENT ${component})
  # And those of what lies inside.
  if(CONDYLE_HDF5_INSIDE AND component MATCHES "command|python")
    foreach(inside libhdf5-dev libaec-dev)
      install(FILES /usr/share/doc/${inside}/copyright RENAME ${inside}.copyright DESTINATION ${licences} COMPONENT ${component}
              OPTIONAL)
    endforeach()
  endif()
endforeach()
install(DIRECTORY ${condyle_api_folder} DESTINATION ${CMAKE_INSTALL_DATAROOTDIR}/doc/condyle-doc OPTIONAL
        COMPONENT documentation)
