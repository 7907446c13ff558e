#include "io/image/voxel_data.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "io/image/label_indices.hpp"

namespace condyle::io {
namespace {

/// Voxels that are read at once: half a megabyte of the largest type.
constexpr std::uint64_t block_voxels = std::uint64_t{1} << 16;
/// Bytes, beside as many as there are voxels, that are inflated behind the voxels for the sake of the checksum. Damage may make
/// data longer; a file that inflates without end is not worth the time.
constexpr std::uint64_t checked_beyond = std::uint64_t{1} << 20;
/// Room for rounding where a program resampled labels as floats.
constexpr double farthest_from_whole = 1e-3;
constexpr double largest_label = std::numeric_limits<std::uint32_t>::max();

/// "layer 1, voxel (3, 0, 2)"
std::string place_of(std::uint64_t value, const VoxelData& data) {
  const std::uint64_t layer = value / data.run % data.layers;
  const std::uint64_t voxel = value / (data.run * data.layers) * data.run + value % data.run;
  const auto ni = static_cast<std::uint64_t>(data.size[0]), nj = static_cast<std::uint64_t>(data.size[1]);
  const auto place = fmt::format("voxel ({}, {}, {})", voxel % ni, voxel / ni % nj, voxel / ni / nj);
  return data.layers > 1 ? fmt::format("layer {}, {}", layer, place) : place;
}

/// Turns stored values into indices of labels.
template <class T>
class Narrower {
 public:
  Narrower(const VoxelData& data, const ByteStream& stream, LabelIndices& indices)
      : data_(data), stream_(stream), indices_(indices) {
    if constexpr (is_tabled) index_of_stored_.assign(std::size_t{1} << (8 * sizeof(T)), unknown);
  }

  /// The values whose number in the file begins at `first`.
  void narrow(std::span<const char> raw, std::uint64_t first, std::span<std::uint16_t> out) {
    for (std::size_t i = 0; i < out.size(); ++i) {
      Stored stored;
      std::memcpy(&stored, raw.data() + i * sizeof(T), sizeof(T));
      if constexpr (is_tabled) {
        auto& index = index_of_stored_[stored];
        if (index == unknown) index = index_of(stored, first + i);
        out[i] = static_cast<std::uint16_t>(index);
      } else {
        if (stored != last_ || last_index_ == unknown) {
          last_index_ = index_of(stored, first + i);
          last_ = stored;
        }
        out[i] = static_cast<std::uint16_t>(last_index_);
      }
    }
  }

 private:
  /// Bits as the file has them, whatever its byte order.
  using Stored = std::conditional_t<
      sizeof(T) == 1, std::uint8_t,
      std::conditional_t<sizeof(T) == 2, std::uint16_t,
                         std::conditional_t<sizeof(T) == 4, std::uint32_t, std::uint64_t>>>;
  static constexpr bool is_tabled = sizeof(T) <= 2;
  static constexpr std::uint32_t unknown = std::numeric_limits<std::uint32_t>::max();

  std::uint32_t index_of(Stored stored, std::uint64_t place) {
    std::array<char, sizeof(T)> bytes;
    std::memcpy(bytes.data(), &stored, sizeof(T));
    if (data_.order != std::endian::native) std::reverse(bytes.begin(), bytes.end());
    const std::uint16_t index = indices_.index_of(label_of(std::bit_cast<T>(bytes), place));
    if (index == LabelIndices::none)
      stream_.fail(fmt::format("{}: more than {} different values: no label map", place_of(place, data_),
                               LabelIndices::most));
    return index;
  }

  std::uint32_t label_of(T stored, std::uint64_t place) const {
    const bool is_scaled = data_.slope != 1 || data_.intercept != 0;
    if constexpr (std::is_integral_v<T>) {
      if (!is_scaled) {
        if (!std::in_range<std::uint32_t>(stored)) refuse(fmt::format("{}", +stored), place);
        return static_cast<std::uint32_t>(stored);
      }
    }
    const double value =
        is_scaled ? data_.slope * static_cast<double>(stored) + data_.intercept : static_cast<double>(stored);
    const double whole = std::round(value);
    if (!(std::abs(value - whole) <= farthest_from_whole)) {
      stream_.fail(fmt::format(
          "{}: value {} is no whole number{}", place_of(place, data_), value,
          is_scaled ? fmt::format(" (slope {}, intercept {}): a map of probabilities is no label map",
                                  data_.slope, data_.intercept)
                    : ""));
    }
    if (!(whole >= 0 && whole <= largest_label)) refuse(fmt::format("{}", value), place);
    return static_cast<std::uint32_t>(whole);
  }

  [[noreturn]] void refuse(const std::string& value, std::uint64_t place) const {
    stream_.fail(fmt::format("{}: value {}: labels are whole numbers from 0 to 4294967295",
                             place_of(place, data_), value));
  }

  const VoxelData& data_;
  const ByteStream& stream_;
  LabelIndices& indices_;
  std::vector<std::uint32_t> index_of_stored_;
  Stored last_ = 0;
  std::uint32_t last_index_ = unknown;
};

/// Deals out values that lie one after the other to their layers, each of which takes them in the order of its voxels.
class Dealer {
 public:
  Dealer(const VoxelData& data, std::vector<std::vector<std::uint16_t>>& layers)
      : run_(data.run), left_(data.run), layers_(layers) {
    layers_.resize(data.layers);
    // Pages that no voxel has reached yet take no memory.
    for (auto& layer : layers_) layer.reserve(data.voxels());
  }

  void deal(std::span<const std::uint16_t> values) {
    while (!values.empty()) {
      const auto count = static_cast<std::size_t>(std::min<std::uint64_t>(values.size(), left_));
      auto& layer = layers_[layer_];
      layer.insert(layer.end(), values.begin(), values.begin() + static_cast<std::ptrdiff_t>(count));
      values = values.subspan(count);
      left_ -= count;
      if (left_ > 0) continue;
      left_ = run_;
      layer_ = layer_ + 1 == layers_.size() ? 0 : layer_ + 1;
    }
  }

 private:
  std::uint64_t run_, left_;
  std::size_t layer_ = 0;
  std::vector<std::vector<std::uint16_t>>& layers_;
};

/// From the order of appearance to ascending labels.
void sort_labels(const LabelIndices& indices, LabelMap& map) {
  const auto& labels = indices.labels();
  std::vector<std::uint16_t> order(labels.size()), rank(labels.size());
  std::iota(order.begin(), order.end(), std::uint16_t{0});
  std::sort(order.begin(), order.end(), [&](auto a, auto b) { return labels[a] < labels[b]; });
  for (std::size_t i = 0; i < order.size(); ++i) {
    rank[order[i]] = static_cast<std::uint16_t>(i);
    map.labels.push_back(labels[order[i]]);
  }
  if (std::is_sorted(rank.begin(), rank.end())) return;
  for (auto& layer : map.layers)
    for (auto& index : layer) index = rank[index];
}

template <class T>
void read_values(ByteStream& stream, const VoxelData& data, LabelMap& map) {
  LabelIndices indices;
  Narrower<T> narrower(data, stream, indices);
  Dealer dealer(data, map.layers);
  const std::uint64_t count = data.voxels() * data.layers;
  const auto block = static_cast<std::size_t>(std::min(count, block_voxels));
  std::vector<char> raw(block * sizeof(T));
  std::vector<std::uint16_t> narrow(block);
  for (std::uint64_t first = 0; first < count; first += block) {
    const auto values = static_cast<std::size_t>(std::min<std::uint64_t>(block, count - first));
    const auto bytes = std::span(raw).first(values * sizeof(T));
    const std::size_t got = stream.read(bytes);
    if (got < bytes.size())
      stream.fail(fmt::format("data: {} bytes of the {} that the header promises", first * sizeof(T) + got,
                              data.bytes()));
    narrower.narrow(bytes, first, std::span(narrow).first(values));
    dealer.deal(std::span(narrow).first(values));
  }
  sort_labels(indices, map);
}

}  // namespace

void check_size(const VoxelData& data, const ByteSource& source, std::string_view element) {
  constexpr std::uint64_t most_voxels = std::uint64_t{1} << 40;
  std::uint64_t left = data.layers == 0 ? 0 : most_voxels / data.layers;
  for (const std::int64_t size : data.size) {
    if (size < 1) source.fail(fmt::format("{}: a size of {}", element, size));
    left /= static_cast<std::uint64_t>(size);
  }
  if (left == 0)
    source.fail(fmt::format("{}: {} x {} x {} voxels are more than 2^40", element, data.size[0], data.size[1],
                            data.size[2]));
}

void read_voxels(ByteStream& stream, const VoxelData& data, LabelMap& map) {
  if (!stream.may_hold(data.bytes()))
    stream.fail(
        fmt::format("data: the file is too short for the {} bytes that the header promises", data.bytes()));
  with_number_type(data.type, [&](auto zero) { read_values<decltype(zero)>(stream, data, map); });
  if (stream.has_more(data.bytes() + checked_beyond))
    map.notes.push_back(
        {LabelNoteCode::more_bytes, fmt::format("The file holds more than the {} bytes of voxels that its "
                                                "header promises: the rest was not read.",
                                                data.bytes())});
  if (data.voxels() == 1)
    map.notes.push_back({LabelNoteCode::empty_segmentation,
                         "The image has a single voxel: 3D Slicer writes an empty segmentation so."});
}

}  // namespace condyle::io
