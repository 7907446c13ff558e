#pragma once

#include <map>
#include <string>
#include <vector>

namespace condyle::test {

/// An element of an SVG drawing with its attributes and its own text.
struct SvgElement {
  std::string name;
  std::map<std::string, std::string> attributes;
  std::string text;

  double number(const std::string& attribute) const { return std::stod(attributes.at(attribute)); }
};

/// All elements in document order, read by VTK's expat: an XML parser that knows nothing of how we write.
/// Empty where the text is not well-formed XML.
std::vector<SvgElement> svg_elements(const std::string& document);

/// Those of one name.
std::vector<SvgElement> elements_named(const std::string& document, const std::string& name);

}  // namespace condyle::test
