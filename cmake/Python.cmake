# The Python that the module is built for: the system's, which has Debian's numpy and pybind11, unless Python_EXECUTABLE names
# another one. The first python3 on PATH may be anybody's and lack numpy.
if(NOT Python_EXECUTABLE AND EXISTS /usr/bin/python3)
  set(Python_EXECUTABLE /usr/bin/python3 CACHE FILEPATH "The Python that the module condyle is built for")
endif()
find_package(Python 3.9 COMPONENTS Interpreter Development.Module NumPy)
find_package(pybind11 2.10 CONFIG QUIET)
if(NOT pybind11_FOUND)
  condyle_missing(pybind11 "; or -DCONDYLE_PYTHON=OFF")
elseif(NOT Python_FOUND OR NOT Python_NumPy_FOUND)
  message(FATAL_ERROR "The Python module needs numpy and the headers of ${Python_EXECUTABLE} "
                      "(Debian: python3-numpy python3-dev), or -DCONDYLE_PYTHON=OFF")
endif()

# Where that Python looks under a prefix; both /usr and /usr/local have it on Debian.
execute_process(COMMAND ${Python_EXECUTABLE} -c "import sysconfig, sys
debian = 'deb_system' in sysconfig.get_scheme_names()
print('lib/python%d.%d/%s' % (*sys.version_info[:2], 'dist-packages' if debian else 'site-packages'))"
                OUTPUT_VARIABLE condyle_python_folder OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
set(CONDYLE_PYTHON_INSTALL_DIR ${condyle_python_folder} CACHE STRING "Where the module condyle is installed, under the prefix")
