#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "io/mesh/parse.hpp"

namespace condyle::io {

/// Deeper or more elements than any model has.
inline constexpr std::size_t deepest_element = 200, most_elements = 2'000'000;

/// An element of an XML file with what is in it. Names and texts are borrowed from the bytes of the file.
struct XmlElement {
  std::string_view name;
  std::string_view name_attribute;  ///< value of name="…", entities as they stand
  std::string_view inside;          ///< from its opening tag to its closing one; empty if it has elements
  std::size_t line = 0;
  std::vector<XmlElement> children;

  /// The first child of this name; null if there is none.
  const XmlElement* child(std::string_view of_name) const noexcept;
  /// The element at a path of names; null if there is none.
  const XmlElement* at(std::initializer_list<std::string_view> path) const noexcept;

  /// Its text: without comments and blanks at both ends, entities decoded. A lone & stands for itself.
  std::string text() const;
  /// Whether a comment stands in it with other than blanks on both sides.
  bool has_comment_in_word() const;
  /// The same of the attribute.
  std::string label() const;
};

/// The tree of a file. FileError with the line for what XmlCursor refuses, for a file of another kind, and for elements
/// nested deeper than deepest_element or more than most_elements.
XmlElement xml_tree(const Source& source);

}  // namespace condyle::io
