#pragma once

#include <span>
#include <string>
#include <vector>

#include "condyle/make_joint.hpp"
#include "io/joint/toml_table.hpp"

namespace condyle::io {

/// The [[part]] tables of a joint file. `mm` is one unit of its lengths.
std::vector<DescribedPart> described_parts(TomlTable& file, Side side, double mm);

/// These tables of a file in mm, for parts about the joint centre that rotate only.
std::string parts_text(std::span<const PosedPart> parts);

}  // namespace condyle::io
