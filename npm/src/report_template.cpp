#include "io/report/page.hpp"

#include <string>

/// As src/io/report/report_template.cpp, from the file beside the program: the page is most of what the package weighs, and few
/// commands want it.

extern "C" {
/// Functions of glue.js: how many bytes the file has, and the bytes.
std::size_t condyle_template_size();
void condyle_template_read(char* bytes);
}

namespace condyle::io {

std::string_view report_template() noexcept {
  static const std::string bytes = [] {
    std::string read(condyle_template_size(), '\0');
    condyle_template_read(read.data());
    return read;
  }();
  return bytes;
}

}  // namespace condyle::io
