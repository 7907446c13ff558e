#include "radial/query/candidates.hpp"

namespace condyle::radial {

void Candidates::gather(std::span<const Vec3> points) {
  std::visit([&](const auto& map) { gather(map, points); }, map_);
}

void Candidates::gather(const CartesianMap& map, std::span<const Vec3> points) {
  of_point_.clear();
  for (const Vec3& v : points) {
    of_point_.push_back(v == Vec3::Zero() ? std::span<const Index>() : entries_.of(map.cell_of(v)));
  }
}

void Candidates::gather(const CubeMap& map, std::span<const Vec3> points) {
  of_point_.assign(points.size(), {});
  place_.clear(), number_.clear();
  std::size_t most = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (points[i] == Vec3::Zero()) continue;
    place_.push_back(map.place_of(points[i]));
    number_.push_back(static_cast<std::uint32_t>(i));
    most += entries_.of(place_.back().cell).size();
  }
  end_.resize(place_.size());
  if (found_.size() < most + vector_padding) found_.resize(most + vector_padding);
  find_candidates(entries_.view(), place_, end_.data(), found_.data());
  std::uint32_t first = 0;
  for (std::size_t k = 0; k < place_.size(); ++k) {
    of_point_[number_[k]] = {found_.data() + first, found_.data() + end_[k]};
    first = end_[k];
  }
}

}  // namespace condyle::radial
