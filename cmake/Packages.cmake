# Debian packages, one for each part that cmake --install knows: docs/install.md. The libraries of C++ are static, so the only
# package of a runtime is that of the C interface.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME condyle)
set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
set(CPACK_PACKAGE_CONTACT "The Condyle authors")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "${PROJECT_DESCRIPTION}")
set(CPACK_PACKAGE_DIRECTORY ${PROJECT_SOURCE_DIR}/out/packages)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_COMPONENTS_ALL command development documentation)
if(CONDYLE_PYTHON)
  list(APPEND CPACK_COMPONENTS_ALL python)
endif()
if(CONDYLE_C)
  list(APPEND CPACK_COMPONENTS_ALL library)
endif()
set(CPACK_STRIP_FILES ON)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)

set(CPACK_DEBIAN_COMMAND_PACKAGE_NAME condyle)
set(CPACK_DEBIAN_COMMAND_PACKAGE_SHLIBDEPS ON)
set(CPACK_COMPONENT_COMMAND_DESCRIPTION "The command condyle: contact of the bones of a joint, its depth, and how far the joint turns.")

set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libcondyle-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS "libeigen3-dev, libtbb-dev, libhwy-dev, libfmt-dev, libtomlplusplus-dev")
# condyle::io only.
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_RECOMMENDS "libhdf5-dev, libaec-dev, zlib1g-dev, liblz4-dev")
set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION "Static libraries and headers, for find_package(condyle) and pkg-config.")
if(CONDYLE_C)
  string(APPEND CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS ", libcondyle1 (= ${PROJECT_VERSION})")
endif()

set(CPACK_DEBIAN_LIBRARY_PACKAGE_NAME libcondyle1)
set(CPACK_DEBIAN_LIBRARY_PACKAGE_SECTION libs)
set(CPACK_DEBIAN_LIBRARY_PACKAGE_SHLIBDEPS ON)
# CPack's own would be made for every package, and warns of the Python module, which has no such name.
file(WRITE ${PROJECT_BINARY_DIR}/shlibs "libcondyle_c 1 libcondyle1 (>= ${PROJECT_VERSION})\n")
set(CPACK_DEBIAN_LIBRARY_PACKAGE_CONTROL_EXTRA ${PROJECT_BINARY_DIR}/shlibs)
set(CPACK_COMPONENT_LIBRARY_DESCRIPTION "The C interface of Condyle, for simulators: libcondyle_c.so.1.")

set(CPACK_DEBIAN_DOCUMENTATION_PACKAGE_NAME condyle-doc)
set(CPACK_DEBIAN_DOCUMENTATION_PACKAGE_SECTION doc)
set(CPACK_DEBIAN_DOCUMENTATION_PACKAGE_ARCHITECTURE all)
set(CPACK_COMPONENT_DOCUMENTATION_DESCRIPTION "The API page and every other page: /usr/share/doc/condyle-doc/api/index.html.")

# Compiled for one version of Python, which is Debian's.
set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-condyle)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SHLIBDEPS ON)
math(EXPR next_python_minor "${Python_VERSION_MINOR} + 1")
string(CONCAT CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS
       "python3 (>= ${Python_VERSION_MAJOR}.${Python_VERSION_MINOR}), "
       "python3 (<< ${Python_VERSION_MAJOR}.${next_python_minor}), python3-numpy")
set(CPACK_DEBIAN_PYTHON_PACKAGE_RECOMMENDS "python3-matplotlib")
set(CPACK_DEBIAN_PYTHON_PACKAGE_SUGGESTS "python3-pandas, python3-xarray")
set(CPACK_COMPONENT_PYTHON_DESCRIPTION "The Python module condyle: numpy in, numpy out, and figures.")

include(CPack)
