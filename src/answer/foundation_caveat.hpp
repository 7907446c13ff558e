#pragma once

namespace condyle::answer {

/// Effects that an elastic foundation leaves out.
inline constexpr const char* foundation_caveat =
    "elastic foundation: thin layers without shear or lateral spread, so peaks run above those of finite "
    "elements";

}  // namespace condyle::answer
