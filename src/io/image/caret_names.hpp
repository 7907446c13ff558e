#pragma once

#include <string_view>
#include <vector>

#include "condyle/io/label_file.hpp"

namespace condyle::io {

/// Names of labels in the XML of a CaretExtension, in layer 0:
///
///   <CaretExtension> ... <Label Key="75" Red="0.2" ...><![CDATA[femur_left]]></Label> ...
///
/// Nothing for a text that is no CaretExtension. `name` is what errors call the file.
std::vector<LabelSegment> caret_names(std::string_view xml, std::string_view name);

}  // namespace condyle::io
