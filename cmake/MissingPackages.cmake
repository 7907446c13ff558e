# Says how to install a package that is not found, on more systems than Condyle is tried on: docs/install.md.
# CMake's name, then that of Debian, Fedora, Arch, Homebrew and conda-forge; - if there is none.
set(condyle_install_commands "apt install" "dnf install" "pacman -S" "brew install" "conda install -c conda-forge")
set(condyle_package_names
    "Eigen3 libeigen3-dev eigen3-devel eigen eigen eigen"
    "TBB libtbb-dev tbb-devel onetbb tbb tbb-devel"
    "Boost libboost-dev boost-devel boost boost libboost-headers"
    "hwy libhwy-dev highway-devel highway highway libhwy"
    "fmt libfmt-dev fmt-devel fmt fmt fmt"
    "ZLIB zlib1g-dev zlib-devel zlib zlib zlib"
    "LZ4 liblz4-dev lz4-devel lz4 lz4 lz4-c"
    "HDF5 libhdf5-dev hdf5-devel hdf5 hdf5 hdf5"
    "nlohmann_json nlohmann-json3-dev json-devel nlohmann-json nlohmann-json nlohmann_json"
    "tomlplusplus libtomlplusplus-dev tomlplusplus-devel tomlplusplus tomlplusplus tomlplusplus"
    "CLI11 libcli11-dev cli11-devel cli11 cli11 cli11"
    "pybind11 pybind11-dev pybind11-devel pybind11 pybind11 pybind11"
    "GTest libgtest-dev gtest-devel gtest googletest gtest"
    "rapidcheck librapidcheck-dev - - - -"
    "VTK libvtk9-dev vtk-devel vtk vtk vtk")

# condyle_missing(NAME [words that end the line]) ends the configuration.
function(condyle_missing name)
  set(ways "")
  set(elsewhere "")
  foreach(row ${condyle_package_names})
    string(REPLACE " " ";" row "${row}")
    list(POP_FRONT row cmake_name)
    if(cmake_name STREQUAL name)
      foreach(command package IN ZIP_LISTS condyle_install_commands row)
        if(NOT package STREQUAL "-")
          list(APPEND ways "${command} ${package}")
        else()
          set(elsewhere ", elsewhere from its sources")
        endif()
      endforeach()
    endif()
  endforeach()
  list(JOIN ways ", " ways)
  message(FATAL_ERROR "condyle: ${name} is missing or too old: ${ways}${elsewhere}${ARGN}")
endfunction()

# find_package(… REQUIRED), whose error says how to install it. A macro: what is found is the caller's.
macro(condyle_find_package name)
  find_package(${name} ${ARGN})
  if(NOT ${name}_FOUND)
    condyle_missing(${name})
  endif()
endmacro()
