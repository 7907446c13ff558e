# HDF5 as it is linked: CONDYLE_HDF5_INCLUDE, CONDYLE_HDF5_LIBRARIES, and CONDYLE_HDF5_OPTIONS for whatever shared library takes
# it in. Its static library where that can be part of a shared one, since the shared one loads 29 others to reach the network:
# docs/decisions/0021-hdf5-inside.md. One header and one library are used; CMake's own module wants a C compiler and links its
# packages too.
find_path(CONDYLE_HDF5_INCLUDE hdf5.h PATH_SUFFIXES hdf5/serial)
if(NOT CONDYLE_HDF5_INCLUDE)
  condyle_missing(HDF5)
endif()
find_library(CONDYLE_HDF5_STATIC NAMES libhdf5_serial.a libhdf5.a PATH_SUFFIXES hdf5/serial)
# Compression of HDF5's that is not used here, but that it knows.
find_library(CONDYLE_SZIP_STATIC libsz.a)
find_library(CONDYLE_AEC_STATIC libaec.a)
find_package(ZLIB REQUIRED)

# Debian's static HDF5 is compiled for programs. A shared library takes it in where its symbols are hidden, and stdout and
# stderr, which are the C library's, are reached through variables inside: src/io/file/wrapped_streams.cpp.
set(condyle_hdf5_archives ${CONDYLE_HDF5_STATIC} ${CONDYLE_SZIP_STATIC} ${CONDYLE_AEC_STATIC})
set(hidden "")
foreach(archive ${condyle_hdf5_archives})
  get_filename_component(name ${archive} NAME)
  list(APPEND hidden ${name})
endforeach()
list(JOIN hidden ":" hidden)
set(condyle_hdf5_options -Wl,--exclude-libs,${hidden} -Wl,--wrap=stdout,--wrap=stderr,--undefined=__wrap_stderr)

if(CONDYLE_HDF5_STATIC AND CONDYLE_SZIP_STATIC AND CONDYLE_AEC_STATIC)
  # One static file takes all of them as they are.
  if(CONDYLE_STATIC)
    set(CONDYLE_HDF5_INSIDE ON)
  endif()
  # A shared library with nothing left open, as a program: CMake tries no others.
  file(WRITE ${CMAKE_BINARY_DIR}/CMakeFiles/hdf5_inside.cpp "#include <hdf5.h>
hid_t created() {
  const hid_t access = H5Pcreate(H5P_FILE_ACCESS);
  H5Pset_fapl_core(access, 1, false);
  return H5Fcreate(\"in_memory.h5\", H5F_ACC_TRUNC, H5P_DEFAULT, access);
}
")
  if(NOT DEFINED CONDYLE_HDF5_INSIDE)
    try_compile(CONDYLE_HDF5_INSIDE ${CMAKE_BINARY_DIR}/CMakeFiles/hdf5_inside
                SOURCES ${CMAKE_BINARY_DIR}/CMakeFiles/hdf5_inside.cpp
                        ${PROJECT_SOURCE_DIR}/src/io/file/wrapped_streams.cpp
                CMAKE_FLAGS -DINCLUDE_DIRECTORIES=${CONDYLE_HDF5_INCLUDE}
                COMPILE_DEFINITIONS -fPIC
                LINK_OPTIONS -shared -Wl,-z,defs ${condyle_hdf5_options}
                LINK_LIBRARIES ${condyle_hdf5_archives} ZLIB::ZLIB ${CMAKE_DL_LIBS} m
                OUTPUT_VARIABLE said)
    if(NOT CONDYLE_HDF5_INSIDE)
      message(STATUS "HDF5 as a shared library: its static one cannot be linked:\n${said}")
    endif()
  endif()
endif()
if(CONDYLE_HDF5_INSIDE)
  set(CONDYLE_HDF5_LIBRARIES ${condyle_hdf5_archives} ${CMAKE_DL_LIBS} ZLIB::ZLIB)
  set(CONDYLE_HDF5_OPTIONS ${condyle_hdf5_options})
else()
  find_library(CONDYLE_HDF5_SHARED NAMES hdf5_serial hdf5 PATH_SUFFIXES hdf5/serial REQUIRED)
  set(CONDYLE_HDF5_LIBRARIES ${CONDYLE_HDF5_SHARED})
  set(CONDYLE_HDF5_OPTIONS "")
endif()
