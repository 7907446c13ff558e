#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "condyle/io/label_file.hpp"

namespace condyle::io {

/// The name that the file gives to a label of a layer, else that of the task's table; empty if neither has one.
std::string name_of_label(const LabelMap& map, std::size_t layer, std::uint32_t label,
                          std::optional<LabelTask> task);

/// "the image holds 76, 78": its labels, the first ones of many.
std::string labels_there(const LabelMap& map);

}  // namespace condyle::io
