# Packages that are headers only, seen through folders of their own by a compiler for another system: those of the machine beside them
# are not for it. condyle_header_packages(package...), folders of /usr/include; their place is condyle_packages.
set(condyle_packages ${CMAKE_BINARY_DIR}/packages)
function(condyle_header_packages)
  file(MAKE_DIRECTORY ${condyle_packages})
  foreach(package ${ARGN})
    cmake_path(GET package FILENAME name)
    file(CREATE_LINK /usr/include/${package} ${condyle_packages}/${name} SYMBOLIC)
  endforeach()
endfunction()
