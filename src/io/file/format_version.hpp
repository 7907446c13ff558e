#pragma once

namespace condyle::io {

/// Version of the joint file format and of the result files this build reads and writes.
inline constexpr int format_version = 1;

}  // namespace condyle::io
