#include "plot_svg_elements.hpp"

#include <vtkObject.h>
#include <vtkSmartPointer.h>
#include <vtkXMLDataElement.h>
#include <vtkXMLUtilities.h>

namespace condyle::test {
namespace {

void collect(vtkXMLDataElement* element, std::vector<SvgElement>& out) {
  SvgElement e;
  e.name = element->GetName();
  for (int i = 0; i < element->GetNumberOfAttributes(); ++i)
    e.attributes[element->GetAttributeName(i)] = element->GetAttributeValue(i);
  if (const char* text = element->GetCharacterData()) e.text = text;
  out.push_back(e);
  for (int i = 0; i < element->GetNumberOfNestedElements(); ++i) collect(element->GetNestedElement(i), out);
}

}  // namespace

std::vector<SvgElement> svg_elements(const std::string& document) {
  vtkObject::GlobalWarningDisplayOff();  // what is not well formed shows in the answer
  const auto root = vtkSmartPointer<vtkXMLDataElement>::Take(
      vtkXMLUtilities::ReadElementFromString(document.c_str(), VTK_ENCODING_UTF_8));
  vtkObject::GlobalWarningDisplayOn();
  std::vector<SvgElement> out;
  if (root) collect(root, out);
  return out;
}

std::vector<SvgElement> elements_named(const std::string& document, const std::string& name) {
  std::vector<SvgElement> out;
  for (SvgElement& element : svg_elements(document))
    if (element.name == name) out.push_back(std::move(element));
  return out;
}

}  // namespace condyle::test
