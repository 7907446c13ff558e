#pragma once

#include <vector>

#include "condyle/make_joint.hpp"
#include "io/joint/toml_table.hpp"

namespace condyle::io {

/// The [[part]] tables of a joint file. `mm` is one unit of its lengths.
std::vector<DescribedPart> described_parts(TomlTable& file, Side side, double mm);

}  // namespace condyle::io
