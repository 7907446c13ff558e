# What the command is linked with: condyle_fmt, condyle_toml, condyle_highway. For CONDYLE_STATIC these are headers and static libraries:
# Debian has fmt and toml++ as headers too, and of Highway three functions are called, which src/simd/highway_targets.cpp has then.
# docs/decisions/0032-static-command.md
set(condyle_fmt fmt::fmt)
set(condyle_toml tomlplusplus::tomlplusplus)
set(condyle_highway hwy::hwy)
if(CONDYLE_STATIC)
  if(CONDYLE_THREADS STREQUAL "tbb")
    message(FATAL_ERROR "CONDYLE_STATIC needs CONDYLE_THREADS=std or none: oneTBB is a shared library")
  endif()
  if(CONDYLE_C OR CONDYLE_PYTHON)
    message(FATAL_ERROR "CONDYLE_STATIC is the command: CONDYLE_C and CONDYLE_PYTHON are shared libraries")
  endif()
  set(condyle_fmt fmt::fmt-header-only)
  set(condyle_toml "")
  set(condyle_highway "")
  set(ZLIB_USE_STATIC_LIBS ON)
  set(CMAKE_FIND_LIBRARY_SUFFIXES .a)
endif()
