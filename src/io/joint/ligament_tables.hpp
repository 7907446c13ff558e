#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "condyle/make_joint.hpp"
#include "io/joint/toml_table.hpp"

namespace condyle::io {

/// The [[ligament]] tables of a joint file: docs/ligaments.md. `mm` is one unit of its lengths.
std::vector<DescribedLigament> described_ligaments(TomlTable& file, const JointDescription& joint, double mm);

/// The same of a text that has nothing but these tables, in the unit of the joint's description. Throws UsageError that begins with "ligaments: ".
std::vector<DescribedLigament> ligaments_of_text(std::string_view toml, const JointDescription& joint);

/// These tables of a file whose unit is `mm`, every bit of their numbers. Points are in the frames of its meshes.
std::string ligaments_text(std::span<const Ligament> ligaments, double mm);

}  // namespace condyle::io
