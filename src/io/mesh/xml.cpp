#include "io/mesh/xml.hpp"

#include <algorithm>

namespace condyle::io {

std::optional<std::string_view> XmlTag::find(std::string_view attribute) const {
  for (const auto& [key, value] : attributes) {
    if (key == attribute) return value;
  }
  return std::nullopt;
}

void XmlCursor::fail(std::string_view what) const {
  const auto before = source_.bytes.substr(0, at_);
  source_.fail(fmt::format("line {}: {}", 1 + std::count(before.begin(), before.end(), '\n'), what));
}

std::optional<XmlTag> XmlCursor::next() {
  if (begun_ && open_.empty()) return std::nullopt;
  do {
    const auto tag = source_.bytes.find('<', at_);
    if (tag == std::string_view::npos) {
      at_ = source_.bytes.size();
      fail(begun_ ? fmt::format("the file ends before {}", in_quotes(fmt::format("</{}>", open_.back())))
                  : "no XML tag");
    }
    at_ = tag;
  } while (skip_remark("<!--", "-->") || skip_remark("<?", "?>") || skip_section());
  begin_ = at_;

  take('<');
  XmlTag tag{XmlTag::Kind::open, {}, {}};
  if (at_ < source_.bytes.size() && source_.bytes[at_] == '/') {
    ++at_;
    tag.kind = XmlTag::Kind::close;
  }
  tag.name = name();
  while (true) {
    skip_space();
    const char c = at_ < source_.bytes.size() ? source_.bytes[at_] : '\0';
    if (c == '/' && tag.kind == XmlTag::Kind::open) {
      ++at_;
      tag.kind = XmlTag::Kind::empty;
      take('>');
      break;
    }
    if (c == '>' || tag.kind == XmlTag::Kind::close) {
      take('>');
      break;
    }
    const auto attribute = name();
    skip_space();
    take('=');
    skip_space();
    const char quote = at_ < source_.bytes.size() && source_.bytes[at_] == '\'' ? '\'' : '"';
    take(quote);
    const auto end = source_.bytes.find(quote, at_);
    if (end == std::string_view::npos)
      fail(fmt::format("the value of {} does not end", in_quotes(attribute)));
    tag.attributes.emplace_back(attribute, source_.bytes.substr(at_, end - at_));
    at_ = end + 1;
  }
  follow(tag);
  return tag;
}

std::string_view XmlCursor::text() const {
  const std::size_t end = std::min(source_.bytes.find('<', at_), source_.bytes.size());
  for (const std::string_view remark : {"<!", "<?"})
    if (source_.bytes.substr(end).starts_with(remark))
      fail(fmt::format("{} stands inside a text or number", in_quotes(source_.bytes.substr(end, 4))));
  return source_.bytes.substr(at_, end - at_);
}

/// Passes over <!-- ... --> and its like, where one begins here.
bool XmlCursor::skip_remark(std::string_view begin, std::string_view end) {
  if (!source_.bytes.substr(at_).starts_with(begin)) return false;
  const auto last = source_.bytes.find(end, at_ + begin.size());
  if (last == std::string_view::npos) fail(fmt::format("'{}' without '{}'", begin, end));
  at_ = last + end.size();
  return true;
}

/// Passes over what begins with <! and is no comment, or refuses it.
bool XmlCursor::skip_section() {
  const std::string_view rest = source_.bytes.substr(at_);
  if (!rest.starts_with("<!")) return false;
  if (sections_ == Sections::refused)
    fail(fmt::format("{} is not read", in_quotes(rest.substr(0, rest.find_first_of(" \t\r\n>", 2)))));
  return skip_remark("<![CDATA[", "]]>") || skip_remark("<!", ">");
}

std::string_view XmlCursor::name() {
  const std::size_t first = at_;
  const auto ends_name = [](char c) {
    return is_space(c) || c == '=' || c == '>' || c == '/' || c == '<' || c == '"';
  };
  while (at_ < source_.bytes.size() && !ends_name(source_.bytes[at_])) ++at_;
  if (at_ == first) fail("a name is missing in a tag");
  return source_.bytes.substr(first, at_ - first);
}

void XmlCursor::skip_space() {
  while (at_ < source_.bytes.size() && is_space(source_.bytes[at_])) ++at_;
}

void XmlCursor::take(char expected) {
  if (at_ == source_.bytes.size()) fail(fmt::format("the file ends where '{}' should be", expected));
  if (source_.bytes[at_] != expected) {
    fail(fmt::format("{} should be '{}'", in_quotes(source_.bytes.substr(at_, 1)), expected));
  }
  ++at_;
}

void XmlCursor::follow(const XmlTag& tag) {
  begun_ = true;
  if (tag.kind == XmlTag::Kind::open) open_.push_back(tag.name);
  if (tag.kind != XmlTag::Kind::close) return;
  if (open_.empty() || open_.back() != tag.name) {
    fail(fmt::format("{} closes what is not open", in_quotes(fmt::format("</{}>", tag.name))));
  }
  open_.pop_back();
}

}  // namespace condyle::io
