#include "support/knee.hpp"

#include <algorithm>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "support/shared_data.hpp"

namespace condyle::test {
namespace {

Mesh cartilage(const std::filesystem::path& folder, const char* name) {
  return read_ply(folder / (std::string(name) + "_cartilage.ply"));
}

Pose pose_of(const NumberTable& states, std::size_t frame, const std::string& joint,
             const std::array<const char*, 3>& angles, const std::string& prefix) {
  const auto value = [&](const std::string& name) {
    return states.rows[frame][states.column("/jointset/" + joint + "/" + prefix + "_" + name + "_r/value")];
  };
  Pose X = Pose::Identity();
  X.linear() = (Eigen::AngleAxisd(-value(angles[0]), Vec3::UnitZ()) *
                Eigen::AngleAxisd(value(angles[1]), Vec3::UnitX()) *
                Eigen::AngleAxisd(value(angles[2]), Vec3::UnitY()))
                   .toRotationMatrix();
  X.translation() = 1000 * Vec3(value("tx"), value("ty"), value("tz"));
  return X;
}

}  // namespace

std::size_t NumberTable::column(const std::string& name) const {
  const auto found = std::find(columns.begin(), columns.end(), name);
  if (found == columns.end()) throw std::runtime_error("no column " + name);
  return static_cast<std::size_t>(found - columns.begin());
}

NumberTable read_sto(const std::filesystem::path& path) {
  std::ifstream file(path);
  NumberTable table;
  std::string line, word;
  while (std::getline(file, line) && line != "endheader") continue;
  std::getline(file, line);
  for (std::istringstream names(line); names >> word;) table.columns.push_back(word);
  while (std::getline(file, line)) {
    std::vector<double> row;
    std::istringstream numbers(line);
    for (double number; numbers >> number;) row.push_back(number);
    if (row.size() == table.columns.size()) table.rows.push_back(row);
  }
  if (table.rows.empty()) throw std::runtime_error(path.string() + " has no rows");
  return table;
}

Pose Knee::tibia_at(std::size_t frame) const {
  return pose_of(states, frame, "knee_r", {"flex", "add", "rot"}, "knee");
}
Pose Knee::patella_at(std::size_t frame) const {
  return pose_of(states, frame, "pf_r", {"flex", "rot", "tilt"}, "pf");
}

double Knee::published(const std::string& contact, std::size_t frame, const std::string& name) const {
  return reference.rows[frame][reference.column(contact + "_contact.casting.total." + name)];
}

std::optional<Knee> shared_knee() {
  const auto data = shared_data();
  if (!data) return std::nullopt;
  const auto folder = *data / "knee_lenhart2015_right";
  return Knee{cartilage(folder, "femur"), cartilage(folder, "tibia"), cartilage(folder, "patella"),
              read_sto(folder / "passive_flexion_states.sto"),
              read_sto(folder / "passive_flexion_contact_reference.sto")};
}

}  // namespace condyle::test
