#include <cstddef>
#include <string_view>

#include "io/report/page.hpp"

// The assembler reads the file into the program, so that an installed one needs none.
asm(".pushsection .rodata\n"
    ".hidden condyle_report_template\n"
    ".globl condyle_report_template\n"
    "condyle_report_template:\n"
    ".incbin \"" CONDYLE_REPORT_TEMPLATE
    "\"\n"
    ".hidden condyle_report_template_end\n"
    ".globl condyle_report_template_end\n"
    "condyle_report_template_end:\n"
    ".byte 0\n"
    ".popsection\n");
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
