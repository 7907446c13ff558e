#include "io/image/caret_names.hpp"

#include <fmt/format.h>

#include <set>

#include "io/file/plain_text.hpp"
#include "io/file/words.hpp"
#include "io/file/xml_entity.hpp"
#include "io/image/text_header.hpp"
#include "io/mesh/xml.hpp"

namespace condyle::io {
namespace {

/// Text outside of CDATA.
std::string plain_characters(std::string_view text, const XmlCursor& cursor) {
  std::string out;
  while (!text.empty()) {
    std::size_t length = 1;
    if (text.front() != '&')
      out += text.front();
    else if (length = append_entity(out, text); length == 0)
      cursor.fail(fmt::format("{} is no entity", in_quotes(text.substr(0, 10))));
    text.remove_prefix(length);
  }
  return out;
}

/// The name of a label: one CDATA section, or plain text.
std::string label_name(std::string_view xml, const XmlCursor& cursor) {
  constexpr std::string_view begin = "<![CDATA[", end = "]]>";
  const std::string_view rest = trimmed(xml.substr(cursor.offset()));
  if (!rest.starts_with(begin)) return plain_text(plain_characters(trimmed(cursor.text()), cursor));
  const auto last = rest.find(end);
  if (last == std::string_view::npos) cursor.fail("a CDATA section does not end");
  return plain_text(rest.substr(begin.size(), last - begin.size()));
}

}  // namespace

std::vector<LabelSegment> caret_names(std::string_view xml, std::string_view name) {
  const std::string element = fmt::format("{}: CaretExtension", name);
  // Extensions are padded with zeros, with blanks by some programs.
  while (!xml.empty() && (xml.back() == '\0' || is_space(xml.back()))) xml.remove_suffix(1);
  if (xml.find("<CaretExtension") == std::string_view::npos) return {};

  XmlCursor cursor({xml, element});
  std::vector<LabelSegment> names;
  std::set<std::uint32_t> keys;
  while (const auto tag = cursor.next()) {
    if (tag->name != "Label" || tag->kind == XmlTag::Kind::close) continue;
    const auto key = tag->find("Key");
    std::uint32_t label = 0;
    if (!key) cursor.fail("a Label without Key");
    if (!parse_number(*key, label)) cursor.fail(fmt::format("Key {} is no label", in_quotes(*key)));
    if (!keys.insert(label).second) cursor.fail(fmt::format("Key {} is given twice", label));
    names.push_back({tag->kind == XmlTag::Kind::empty ? "" : label_name(xml, cursor), "", 0, label});
  }
  return names;
}

}  // namespace condyle::io
