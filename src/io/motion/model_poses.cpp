#include "io/motion/model_poses.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "condyle/error.hpp"
#include "condyle/io/model_file.hpp"
#include "io/file/in_quotes.hpp"
#include "io/model/spatial_transform.hpp"
#include "io/motion/column_names.hpp"
#include "io/motion/coordinate_limits.hpp"
#include "io/motion/gaps.hpp"

namespace condyle::io {
namespace {

/// Couplers that follow one another are followed this far, and through this many coordinates in all.
constexpr int longest_chain = 20;
constexpr std::size_t most_coordinates = 1000;

/// The column of a joint's coordinate: of its name, or of a path that ends in joint, coordinate and "value".
std::optional<std::size_t> column_of(const MotionTable& table, const std::string& joint,
                                     const std::string& coordinate) {
  return find_column(table, joint + "/" + coordinate);
}

class ModelMotion {
 public:
  ModelMotion(const MotionTable& table, const PosesOfModel& mapping)
      : table_(table), mapping_(mapping), model_(read_model(mapping.model)) {
    joint_ = &named();
    // The first of each name counts.
    for (const ModelCoupler& coupler : model_.couplers) couplers_.emplace(coupler.dependent, &coupler);
    for (const ModelJoint& joint : model_.joints)
      for (const ModelCoordinate& own : joint.coordinates) owners_.emplace(own.name, Owner{&joint, &own});
  }

  RecordedPoses poses() {
    RecordedPoses out{.times = frame_times(table_), .X_FM = {}, .processing = table_.processing};
    processing_ = &out.processing;
    out.processing.push_back(fmt::format("posed by joint {} of {} (sha256 {})", in_quotes(joint_->name),
                                         mapping_.model.string(), model_.digest.sha256));
    require_columns();
    std::vector<std::vector<double>> values;
    BeyondLimits beyond;
    std::vector<std::vector<double>> degrees_by_header;
    for (const ModelCoordinate& coordinate : joint_->coordinates) {
      values.push_back(values_of(*joint_, coordinate, 0));
      if (const auto column = column_of(table_, joint_->name, coordinate.name);
          column && coordinate.motion == CoordinateMotion::rotational && table_.in_degrees.value_or(false))
        degrees_by_header.push_back(table_.values[*column]);
      check(coordinate, values.back(), beyond);
      check_unit(coordinate, values.back(), out.notes);
    }
    motion::add_new(out.notes, beyond.notes());
    if (auto note = motion::check_degrees(degrees_by_header)) motion::add_new(out.notes, {std::move(*note)});
    std::vector<double> q(values.size());
    for (std::size_t row = 0; row < table_.rows; ++row) {
      for (std::size_t i = 0; i < q.size(); ++i) q[i] = values[i][row];
      if (std::any_of(q.begin(), q.end(), [](double value) { return std::isnan(value); })) {
        out.X_FM.emplace_back();
        continue;
      }
      Pose X = pose_of(*joint_, q);
      if (!X.matrix().allFinite())
        throw FileError(fmt::format("{}: line {}: the functions of joint {} give no finite pose here",
                                    table_.path.string(), table_.line_of_row[row], in_quotes(joint_->name)));
      X.translation() *= mm_per(LengthUnit::metres);
      out.X_FM.emplace_back(X);
    }
    note_gaps(table_, out.X_FM, out.processing);
    return out;
  }

 private:
  const ModelJoint& named() const {
    try {
      return joint_named(model_, mapping_.joint);
    } catch (const UsageError& error) {
      throw FileError(error.what());
    }
  }

  void require_columns() const {
    if (joint_->coordinates.empty())
      throw FileError(
          fmt::format("{}: joint {} does not move", mapping_.model.string(), in_quotes(joint_->name)));
    std::set<std::string_view> looked_at;
    for (const ModelCoordinate& coordinate : joint_->coordinates)
      if (has_source(coordinate.name, looked_at)) return;
    throw FileError(fmt::format("{}: has no column of joint {}: {} or the like{}", table_.path.string(),
                                in_quotes(joint_->name), in_quotes(joint_->coordinates.front().name),
                                those_there(table_.columns)));
  }

  /// Whether a column gives this coordinate, or couplers do by columns of others. Each coordinate is looked at once.
  bool has_source(const std::string& coordinate, std::set<std::string_view>& looked_at) const {
    if (!looked_at.insert(coordinate).second) return false;
    const ModelJoint* joint = owner_of(coordinate).joint;
    if (joint && column_of(table_, joint->name, coordinate)) return true;
    const ModelCoupler* coupler = coupler_of(coordinate);
    return coupler && looked_at.size() <= most_coordinates &&
           std::any_of(coupler->independent.begin(), coupler->independent.end(),
                       [&](const std::string& name) { return has_source(name, looked_at); });
  }

  const ModelCoupler* coupler_of(const std::string& dependent) const {
    const auto found = couplers_.find(dependent);
    return found == couplers_.end() ? nullptr : found->second;
  }

  /// The joint that has a coordinate, and the coordinate.
  struct Owner {
    const ModelJoint* joint = nullptr;
    const ModelCoordinate* coordinate = nullptr;
  };
  Owner owner_of(const std::string& coordinate) const {
    const auto found = owners_.find(coordinate);
    return found == owners_.end() ? Owner() : found->second;
  }

  /// Whether the file's angles are degrees; nothing if neither it nor the joint file says so.
  std::optional<bool> has_degrees() const {
    if (table_.in_degrees && mapping_.in_degrees && *table_.in_degrees != *mapping_.in_degrees)
      throw FileError(fmt::format("{}: angles are given in {}, and the header says inDegrees={}",
                                  table_.path.string(), *mapping_.in_degrees ? "degrees" : "radians",
                                  *table_.in_degrees ? "yes" : "no"));
    return table_.in_degrees ? table_.in_degrees : mapping_.in_degrees;
  }

  bool in_degrees(const ModelCoordinate& coordinate) const {
    if (coordinate.motion == CoordinateMotion::translational) return false;
    const std::optional<bool> degrees = has_degrees();
    if (coordinate.motion == CoordinateMotion::coupled) {
      if (degrees.value_or(false))
        processing_->push_back(
            fmt::format("{}: coordinate {} turns the joint through a function: its column is in radians, "
                        "whatever the header says",
                        table_.path.string(), in_quotes(coordinate.name)));
      return false;
    }
    if (!degrees)
      throw FileError(
          fmt::format("{}: column {}: the file does not say whether angles are in degrees: give angles = "
                      "\"deg\" or \"rad\" in [recorded_motion]",
                      table_.path.string(), in_quotes(coordinate.name)));
    return *degrees;
  }

  /// In radians and metres, NaN for gaps. Several couplers may need one coordinate: it is computed once.
  const std::vector<double>& values_of(const ModelJoint& joint, const ModelCoordinate& coordinate,
                                       int steps) {
    if (const auto known = values_.find(&coordinate); known != values_.end()) return known->second;
    std::vector<double> values = computed_values(joint, coordinate, steps);
    if (values_.size() == most_coordinates)
      throw FileError(fmt::format("{}: joint {}: hangs by constraints on more than {} coordinates",
                                  mapping_.model.string(), in_quotes(joint_->name), most_coordinates));
    return values_.emplace(&coordinate, std::move(values)).first->second;
  }

  std::vector<double> computed_values(const ModelJoint& joint, const ModelCoordinate& coordinate, int steps) {
    if (const auto column = column_of(table_, joint.name, coordinate.name)) {
      std::vector<double> values = table_.values[*column];
      if (in_degrees(coordinate))
        for (double& value : values) value *= std::numbers::pi / 180;
      return values;
    }
    if (const ModelCoupler* coupler = coupler_of(coordinate.name)) return coupled(*coupler, steps);
    processing_->push_back(
        fmt::format("{}: has no column of coordinate {}: its default, {}, stands in for it",
                    table_.path.string(), in_quotes(coordinate.name), coordinate.default_value));
    return std::vector<double>(table_.rows, coordinate.default_value);
  }

  std::vector<double> coupled(const ModelCoupler& coupler, int steps) {
    if (!coupler.function) throw FileError(coupler.why_not);
    if (steps == longest_chain)
      throw FileError(fmt::format("{}: constraint {}: couplers follow one another in a circle",
                                  mapping_.model.string(), in_quotes(coupler.name)));
    std::vector<const std::vector<double>*> of;  // which the map keeps where they are
    for (const std::string& name : coupler.independent) {
      const auto [joint, coordinate] = owner_of(name);
      if (!coordinate)
        throw FileError(fmt::format("{}: constraint {}: there is no coordinate {}", mapping_.model.string(),
                                    in_quotes(coupler.name), in_quotes(name)));
      if (!joint->transform) throw FileError(joint->why_not);
      of.push_back(&values_of(*joint, *coordinate, steps + 1));
    }
    processing_->push_back(fmt::format("{}: has no column of coordinate {}: constraint {} gives it",
                                       table_.path.string(), in_quotes(coupler.dependent),
                                       in_quotes(coupler.name)));
    std::vector<double> values(table_.rows), q(of.size());
    for (std::size_t row = 0; row < table_.rows; ++row) {
      for (std::size_t i = 0; i < q.size(); ++i) q[i] = (*of[i])[row];
      values[row] = coupler.function->scale * value_of(coupler.function->function, q);
    }
    return values;
  }

  void check(const ModelCoordinate& coordinate, std::vector<double> values, BeyondLimits& beyond) const {
    const bool is_length = coordinate.motion == CoordinateMotion::translational;
    const double unit = is_length ? mm_per(LengthUnit::metres) : 180 / std::numbers::pi;
    CoordinateLimits limits{joint_->name + "/" + coordinate.name,
                            is_length ? CoordinateKind::length : CoordinateKind::angle};
    if (coordinate.range) limits.range = {unit * coordinate.range->front(), unit * coordinate.range->back()};
    if (coordinate.is_locked && column_of(table_, joint_->name, coordinate.name))
      limits.locked_at = unit * coordinate.default_value;
    for (double& value : values) value *= unit;
    beyond.check(limits, values);
  }

  /// Notes angles that look like another unit. Lengths are checked by the poses that they lead to.
  static void check_unit(const ModelCoordinate& coordinate, const std::vector<double>& values,
                         std::vector<motion::ContactNote>& notes) {
    if (coordinate.motion == CoordinateMotion::translational) return;
    double largest = 0;
    for (const double value : values)
      if (!std::isnan(value)) largest = std::max(largest, std::abs(value));
    if (auto note = motion::check_recorded(coordinate.name, motion::RecordedKind::angle_deg,
                                           largest * 180 / std::numbers::pi))
      motion::add_new(notes, {std::move(*note)});
  }

  const MotionTable& table_;
  const PosesOfModel& mapping_;
  Model model_;
  std::map<std::string_view, const ModelCoupler*> couplers_;  ///< by the coordinate that follows
  std::map<std::string_view, Owner> owners_;                  ///< by their coordinates
  std::map<const ModelCoordinate*, std::vector<double>> values_;
  const ModelJoint* joint_ = nullptr;
  std::vector<std::string>* processing_ = nullptr;
};

}  // namespace

RecordedPoses model_poses(const MotionTable& table, const PosesOfModel& mapping) {
  return ModelMotion(table, mapping).poses();
}

}  // namespace condyle::io
