// stdout and stderr of a shared library that a static HDF5 is part of. Debian compiles that one for programs, whose linker can
// give a variable of the C library a place of their own; in a shared library it has to lie in the library itself. Linked with
// --wrap (cmake/Hdf5.cmake), which makes these names and no others; a program is linked without, and takes nothing from here.

#include <cstdio>

extern "C" {

extern FILE* __real_stdout;
extern FILE* __real_stderr;
[[gnu::visibility("hidden")]] FILE* __wrap_stdout = nullptr;
[[gnu::visibility("hidden")]] FILE* __wrap_stderr = nullptr;
}

namespace {

/// Before the library's own variables are made, which may write already.
[[gnu::constructor(101)]] void find_streams() {
  __wrap_stdout = __real_stdout;
  __wrap_stderr = __real_stderr;
}

}  // namespace
