#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "condyle/mesh.hpp"
#include "condyle/pose.hpp"

/// The knee of the shared data with its simulated flexion and the contact results published for it
/// (knee_lenhart2015_right/README.md).

namespace condyle::test {

/// Rows of numbers under named columns.
struct NumberTable {
  std::vector<std::string> columns;
  std::vector<std::vector<double>> rows;

  std::size_t column(const std::string& name) const;
};
/// Reads the table after `endheader`.
NumberTable read_sto(const std::filesystem::path& path);

struct Knee {
  Mesh femur_cartilage, tibia_cartilage, patella_cartilage;
  NumberTable states, reference;

  /// Pose of tibia or patella in the femur: p_femur = Rz(-flexion) Rx(second) Ry(third) p + t, mm.
  Pose tibia_at(std::size_t frame) const;
  Pose patella_at(std::size_t frame) const;
  /// A number published for contact "tf" or "pf", in SI units.
  double published(const std::string& contact, std::size_t frame, const std::string& name) const;
};

/// None if the shared data is missing.
std::optional<Knee> shared_knee();

}  // namespace condyle::test
