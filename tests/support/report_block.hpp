#pragma once

#include <cstring>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace condyle::test {

/// The data of a report, read as docs/report-data.md describes them and by other means than they were written.
struct ReportBlock {
  nlohmann::json json;
  std::string arrays;

  /// An array of the block, checked to be of this type and within the block. Throws std::runtime_error.
  template <class Element>
  std::vector<Element> array(const std::string& name, std::string_view type) const {
    const nlohmann::json& entry = json.at("arrays").at(name);
    const std::size_t offset = entry.at("offset"), length = entry.at("length");
    if (entry.at("type") != type || offset % 8 != 0 || offset + length * sizeof(Element) > arrays.size())
      throw std::runtime_error(name + ": is not such an array");
    std::vector<Element> elements(length);
    if (length > 0) std::memcpy(elements.data(), arrays.data() + offset, length * sizeof(Element));
    return elements;
  }
};

/// The element that holds the data, and what is in it, decoded. Throws std::runtime_error where something is not
/// as described.
std::string data_element(const std::string& html);
ReportBlock report_block(const std::string& html);

}  // namespace condyle::test
