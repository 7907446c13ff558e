#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "condyle/io/label_file.hpp"
#include "io/image/text_header.hpp"

namespace condyle::io {

/// The header of an NRRD file: fields under their names in lower case, pairs of keys and values as they are.
struct NrrdHeader {
  HeaderFields fields;
  std::map<std::string, std::string> pairs;
  std::uint64_t data_offset = 0;  ///< where the header ends
};

/// Raises FileError for what is no NRRD header, for a field that NRRD does not know, and for one that is given twice.
NrrdHeader read_nrrd_header(const ByteSource& source);

/// "(1,0,0)" as its numbers, nothing for "none". `text` loses what was read.
std::optional<std::array<double, 3>> next_vector(const HeaderFields& fields, const std::string& key,
                                                 std::string_view& text);

/// Names of segments that 3D Slicer writes into .seg.nrrd: SegmentN_Name, _ID, _LabelValue, _Layer. Older files lack the last
/// two: segment N is then the value 1 in layer N.
std::vector<LabelSegment> slicer_segments(const NrrdHeader& header, std::uint64_t layers);

}  // namespace condyle::io
