#include <cstddef>
#include <string_view>

#include "io/report/page.hpp"

/// As src/io/report/report_template.cpp, in the words of an assembler for Windows.

asm(".section .rdata,\"dr\"\n"
    ".globl condyle_report_template\n"
    "condyle_report_template:\n"
    ".incbin \"" CONDYLE_REPORT_TEMPLATE
    "\"\n"
    ".globl condyle_report_template_end\n"
    "condyle_report_template_end:\n"
    ".byte 0\n"
    ".text\n");
extern "C" {
extern const char condyle_report_template[];
extern const char condyle_report_template_end[];
}

namespace condyle::io {

std::string_view report_template() noexcept {
  return {condyle_report_template,
          static_cast<std::size_t>(condyle_report_template_end - condyle_report_template)};
}

}  // namespace condyle::io
