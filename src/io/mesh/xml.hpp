#pragma once

#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "io/mesh/parse.hpp"

namespace condyle::io {

struct XmlTag {
  enum class Kind { open, close, empty };  ///< <a>, </a>, <a/>

  Kind kind;
  std::string_view name;
  std::vector<std::pair<std::string_view, std::string_view>> attributes;

  std::optional<std::string_view> find(std::string_view attribute) const;
};

/// Goes from tag to tag through the XML that VTK and OpenSim write, and holds that tags close in the order they opened.
/// Comments and declarations are passed over, entities stay as they are: no text grows, and no other file is opened. An XML
/// parser proper would not do: data appended raw is not XML.
class XmlCursor {
 public:
  /// Whether DOCTYPE, ENTITY and CDATA are passed over, or are errors.
  enum class Sections { skipped, refused };

  explicit XmlCursor(const Source& source, Sections sections = Sections::skipped)
      : source_(source), sections_(sections) {}

  /// The next tag; nothing once the outermost one has closed.
  std::optional<XmlTag> next();
  /// The text up to the next tag. Fails for one with a comment or a section in it, of which it would be the first part.
  std::string_view text() const;
  /// Where the last tag began and ended.
  std::size_t begin() const noexcept { return begin_; }
  std::size_t offset() const noexcept { return at_; }
  /// Names of the tags that are open, outermost first.
  const std::vector<std::string_view>& path() const noexcept { return open_; }

  [[noreturn]] void fail(std::string_view what) const;

 private:
  bool skip_remark(std::string_view begin, std::string_view end);
  bool skip_section();
  std::string_view name();
  void skip_space();
  void take(char expected);
  void follow(const XmlTag& tag);

  Source source_;
  Sections sections_;
  std::size_t at_ = 0, begin_ = 0;
  std::vector<std::string_view> open_;
  bool begun_ = false;
};

}  // namespace condyle::io
