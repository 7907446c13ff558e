#include "io/model/xml_tree.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "io/file/words.hpp"
#include "io/file/xml_entity.hpp"
#include "io/mesh/parse.hpp"
#include "io/mesh/xml.hpp"

namespace condyle::io {
namespace {

std::string decoded(std::string_view text) {
  std::string out;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t entity = text[at] == '&' ? append_entity(out, text.substr(at)) : 0;
    if (entity == 0) out += text[at];
    at += std::max<std::size_t>(entity, 1);
  }
  return out;
}

std::string without_comments(std::string_view text) {
  std::string out;
  while (true) {
    const std::size_t begin = text.find("<!--");
    out += text.substr(0, begin);
    if (begin == text.npos) return out;
    text.remove_prefix(text.find("-->", begin) + 3);  // a cursor has found its end
  }
}

}  // namespace

const XmlElement* XmlElement::child(std::string_view of_name) const noexcept {
  const auto found = std::find_if(children.begin(), children.end(),
                                  [&](const XmlElement& element) { return element.name == of_name; });
  return found == children.end() ? nullptr : &*found;
}

const XmlElement* XmlElement::at(std::initializer_list<std::string_view> path) const noexcept {
  const XmlElement* element = this;
  for (const std::string_view step : path) {
    if (!element) break;
    element = element->child(step);
  }
  return element;
}

std::string XmlElement::text() const {
  return decoded(trimmed(without_comments(inside)));
}

bool XmlElement::has_comment_in_word() const {
  bool was_in_word = false;
  std::string_view text = inside;
  for (std::size_t begin = text.find("<!--"); begin != text.npos; begin = text.find("<!--")) {
    if (begin > 0) was_in_word = !is_space(text[begin - 1]);
    text.remove_prefix(text.find("-->", begin) + 3);
    if (was_in_word && !text.empty() && !is_space(text.front()) && !text.starts_with("<!--")) return true;
  }
  return false;
}

std::string XmlElement::label() const {
  return decoded(trimmed(name_attribute));
}

XmlElement xml_tree(const Source& source) {
  XmlCursor cursor(source, XmlCursor::Sections::refused);
  XmlElement root;
  std::vector<XmlElement*> open{&root};
  std::size_t line = 1, counted = 0, elements = 0, text_begin = 0;
  while (const auto tag = cursor.next()) {
    const std::string_view passed = source.bytes.substr(counted, cursor.begin() - counted);
    line += static_cast<std::size_t>(std::count(passed.begin(), passed.end(), '\n'));
    counted = cursor.begin();
    if (tag->kind == XmlTag::Kind::close) {
      XmlElement& element = *open.back();
      if (element.children.empty())
        element.inside = source.bytes.substr(text_begin, cursor.begin() - text_begin);
      open.pop_back();
      continue;
    }
    if (++elements > most_elements) cursor.fail(fmt::format("more than {} elements", most_elements));
    if (open.size() > deepest_element)
      cursor.fail(fmt::format("elements nested deeper than {}", deepest_element));
    XmlElement element{tag->name, tag->find("name").value_or(""), {}, line, {}};
    if (open.size() == 1) element.name_attribute = tag->find("Version").value_or("");
    open.back()->children.push_back(std::move(element));
    if (tag->kind == XmlTag::Kind::open) open.push_back(&open.back()->children.back());
    text_begin = cursor.offset();
  }
  return std::move(root.children.front());
}

}  // namespace condyle::io
