#pragma once

#include <windows.h>

namespace condyle::io {

/// The error of <cerrno> that POSIX has for one of Windows' own.
int error_of(DWORD of_windows) noexcept;

}  // namespace condyle::io
