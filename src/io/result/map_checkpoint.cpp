#include "condyle/io/map_checkpoint.hpp"

#include <fmt/format.h>

#include <bit>
#include <cassert>
#include <cmath>
#include <cstring>
#include <span>
#include <string>
#include <string_view>

#include "condyle/error.hpp"
#include "condyle/io/whole_file.hpp"

namespace condyle {
namespace {

static_assert(std::endian::native == std::endian::little,
              "checkpoints are written as the machine has numbers");

/// Of the layout below and of the way points are computed: files of another number are not read.
constexpr std::string_view first_bytes = "condyle map checkpoint 1\n";

class Fnv1a {
 public:
  void add(std::span<const std::byte> bytes) noexcept {
    for (const std::byte b : bytes) hash_ = (hash_ ^ static_cast<std::uint64_t>(b)) * 0x100000001b3u;
  }
  template <class T>
  void add(const T& value) noexcept {
    static_assert(std::has_unique_object_representations_v<T> || std::is_floating_point_v<T>);
    add(std::as_bytes(std::span(&value, 1)));
  }
  template <class T>
  void add(const std::vector<T>& values) noexcept {
    add(values.size());
    add(std::as_bytes(std::span(values)));
  }
  std::uint64_t hash() const noexcept { return hash_; }

 private:
  std::uint64_t hash_ = 0xcbf29ce484222325u;
};

void add(Fnv1a& hash, const TriMesh& mesh) {
  for (const std::vector<double>* coordinate : {&mesh.vertices.x, &mesh.vertices.y, &mesh.vertices.z})
    hash.add(*coordinate);
  hash.add(mesh.triangles);
}

void add(Fnv1a& hash, const JointAngles& angles) {
  for (const Angle angle : {angles.flexion, angles.adduction, angles.internal_rotation})
    hash.add(angle.radians());
}

// Members are taken apart by name everywhere below: a member added to one of these types does not compile
// here until it is part of the key.

void add(Fnv1a& hash, const GridAxis& axis) {
  const auto& [angle, first, last, step] = axis;
  hash.add(angle), hash.add(first), hash.add(last), hash.add(step);
}

void add(Fnv1a& hash, const MapGrid& grid) {
  const auto& [row, column, vary, start, range] = grid;
  add(hash, row), add(hash, column);
  hash.add(vary);
  const auto& [negative, positive] = range;
  for (const Angle angle : {start, negative, positive}) hash.add(angle.radians());
}

void add(Fnv1a& hash, const std::optional<ArticularRegion>& region) {
  hash.add(std::uint8_t{region.has_value()});
  if (!region) return;
  const auto& [radius_mm, cone] = *region;
  hash.add(radius_mm);
  hash.add(std::uint8_t{cone.has_value()});
  if (!cone) return;
  const auto& [axis, half_angle] = *cone;
  for (int i = 0; i < 3; ++i) hash.add(axis[i]);
  hash.add(half_angle.radians());
}

void add(Fnv1a& hash, const OverlapOptions& overlap) {
  const auto& [rest, contact_at_rest, leave_out_region, leave_out_rest_contacts] = overlap;
  add(hash, rest);
  hash.add(contact_at_rest);
  add(hash, leave_out_region);
  hash.add(std::uint8_t{leave_out_rest_contacts.has_value()});
  if (!leave_out_rest_contacts) return;
  const auto& [rings] = *leave_out_rest_contacts;
  hash.add(rings);
}

void add(Fnv1a& hash, const RangeOptions& options) {
  const auto& [articular, overlap] = options;
  add(hash, articular), add(hash, overlap);
}

/// Puts numbers behind each other.
class Writer {
 public:
  template <class T>
  void put(const T& value) {
    static_assert(std::is_arithmetic_v<T> || std::is_enum_v<T>);
    char bytes[sizeof value];
    std::memcpy(bytes, &value, sizeof value);
    text_.append(bytes, sizeof value);
  }
  void put(const Vec3& p) { put(p.x()), put(p.y()), put(p.z()); }
  void put(const Feature& f) { put(f.kind), put(f.id), put(f.other_end); }
  void put(const TurnEnd& end) {
    put(end.turned.radians());
    put(end.reason);
    put(std::uint8_t{end.articular});
    put(end.shortfall.radians());
    put(std::uint8_t{end.contact.has_value()});
    if (!end.contact) return;
    put(end.contact->fixed_feature), put(end.contact->mobile_feature);
    put(end.contact->fixed_point), put(end.contact->mobile_point);
  }
  void put_text(std::string_view text) { text_ += text; }
  const std::string& text() const noexcept { return text_; }

 private:
  std::string text_;
};

/// Takes numbers from the start of a text that may be too short or hold anything.
class Reader {
 public:
  Reader(std::string_view text, const std::filesystem::path& path) : text_(text), path_(path) {}

  template <class T>
  T number() {
    static_assert(std::is_arithmetic_v<T>);
    if (text_.size() < sizeof(T)) fail();
    T value;
    std::memcpy(&value, text_.data(), sizeof value);
    text_.remove_prefix(sizeof value);
    return value;
  }
  /// One of the values 0 to `last`.
  template <class Enum>
  Enum one_of(Enum last) {
    const auto value = number<std::uint8_t>();
    if (value > static_cast<std::uint8_t>(last)) fail();
    return static_cast<Enum>(value);
  }
  bool yes_or_no() { return one_of(std::uint8_t{1}) != 0; }
  Angle angle() {
    const double radians = number<double>();
    if (!std::isfinite(radians)) fail();
    return Angle::radians(radians);
  }
  Vec3 vector() {
    const double x = number<double>(), y = number<double>(), z = number<double>();
    return {x, y, z};
  }
  Feature feature() {
    Feature f;
    f.kind = one_of(FeatureKind::face);
    f.id = number<Index>();
    f.other_end = number<Index>();
    return f;
  }
  TurnEnd end() {
    TurnEnd end;
    end.turned = angle();
    end.reason = one_of(LimitReason::contact_at_start);
    end.articular = yes_or_no();
    end.shortfall = angle();
    if (!yes_or_no()) return end;
    end.contact.emplace();
    end.contact->fixed_feature = feature();
    end.contact->mobile_feature = feature();
    end.contact->fixed_point = vector();
    end.contact->mobile_point = vector();
    return end;
  }
  bool at_end() const noexcept { return text_.empty(); }
  [[noreturn]] void fail() const {
    throw FileError(path_.string() + ": is not a whole map checkpoint; remove it to start anew");
  }

 private:
  std::string_view text_;
  const std::filesystem::path& path_;
};

std::uint64_t sum_of(std::string_view bytes) noexcept {
  Fnv1a sum;
  sum.add(std::as_bytes(std::span(bytes)));
  return sum.hash();
}

}  // namespace

MapKey map_key(const Joint& joint, const RangeOptions& options, const MapGrid& grid) {
  Fnv1a hash;
  hash.add(joint.kind), hash.add(joint.side);
  add(hash, joint.fixed.mesh), add(hash, joint.mobile.mesh);
  add(hash, grid), add(hash, options);
  return hash.hash();
}

/// first_bytes, key, number of points of the grid, number of points known; for each of those its number and
/// its two ends; the FNV-1a hash of all before it.
void write_checkpoint(const std::filesystem::path& path, const MotionMap& map, MapKey key) {
  Writer out;
  out.put_text(first_bytes);
  out.put(key);
  out.put(std::uint64_t{map.points.size()});
  out.put(std::uint64_t{map.done()});
  for (std::size_t i = 0; i < map.points.size(); ++i) {
    if (!map.points[i]) continue;
    out.put(std::uint64_t{i});
    out.put(map.points[i]->negative);
    out.put(map.points[i]->positive);
  }
  out.put(sum_of(out.text()));
  write_whole_file(path, out.text());
}

Resumed read_checkpoint(const std::filesystem::path& path, MapKey key, MotionMap& map) {
  assert(map.done() == 0);
  if (!std::filesystem::exists(path)) return Resumed::nothing;
  const std::string bytes = read_whole_file(path);
  std::string_view text = bytes;
  Reader whole(text, path);
  if (!text.starts_with(first_bytes) || text.size() < first_bytes.size() + sizeof(std::uint64_t))
    whole.fail();
  const std::string_view hashed = text.substr(0, text.size() - sizeof(std::uint64_t));
  if (Reader(text.substr(hashed.size()), path).number<std::uint64_t>() != sum_of(hashed)) whole.fail();

  Reader in(hashed.substr(first_bytes.size()), path);
  if (in.number<std::uint64_t>() != key) return Resumed::other_question;
  if (in.number<std::uint64_t>() != map.points.size()) in.fail();
  std::vector<std::optional<MapPoint>> points(map.points.size());
  for (auto left = in.number<std::uint64_t>(); left > 0; --left) {
    const auto point = in.number<std::uint64_t>();
    if (point >= points.size() || points[point]) in.fail();
    points[point] = MapPoint{in.end(), in.end()};
  }
  if (!in.at_end()) in.fail();
  map.points = std::move(points);
  return Resumed::points;
}

}  // namespace condyle
