# What the public headers include, directly or not, is themselves, Eigen and the standard library; and condyle.hpp has
# all of the core's. Run as cmake -DSOURCE=... -DCOMPILER=... -DPUBLIC=... -P public_headers.cmake.

cmake_minimum_required(VERSION 3.25)

set(include ${SOURCE}/include)
file(GLOB_RECURSE headers RELATIVE ${include} ${include}/condyle/*.hpp)
file(STRINGS ${include}/condyle/condyle.hpp umbrella REGEX "#include")

# The compiler's list of all files that one file is made of.
set(lines "")
foreach(header ${headers})
  string(APPEND lines "#include \"${header}\"\n")
  if(NOT header MATCHES "^condyle/(io/|sample/|condyle\\.hpp)" AND NOT "#include \"${header}\"" IN_LIST umbrella)
    message(SEND_ERROR "condyle.hpp must include ${header}")
  endif()
endforeach()
set(public_flags)
foreach(folder ${PUBLIC})
  list(APPEND public_flags -isystem ${folder})
endforeach()
file(WRITE all_public_headers.cpp "${lines}")
execute_process(COMMAND ${COMPILER} -std=c++20 -H -fsyntax-only -I ${include} ${public_flags} all_public_headers.cpp
                ERROR_VARIABLE opened RESULT_VARIABLE failed)
if(failed)
  message(FATAL_ERROR "the public headers do not compile: ${opened}")
endif()

# Lines are ". path", ".. path": one dot for each level.
string(REPLACE "\n" ";" opened "${opened}")
set(counted 0)
foreach(line ${opened})
  if(line MATCHES "^\\.+ (.*)$")
    set(file "${CMAKE_MATCH_1}")
    math(EXPR counted "${counted} + 1")
    if(file MATCHES "^${include}/")
      set(from "${file}")
    elseif(file MATCHES "/(hwy|tbb|oneapi|boost|vtk[^/]*|hdf5|fmt|nlohmann|toml\\+\\+|CLI)/|^${SOURCE}/")
      message(SEND_ERROR "${from} (or what it includes) must not include ${file}")
    endif()
  endif()
endforeach()
if(counted LESS 100)
  message(SEND_ERROR "only ${counted} files were opened: has the compiler another way to say so?")
endif()
