#pragma once

#include <string>
#include <string_view>

namespace condyle::io {

/// The page without data, as it was built from viewer/: it lies in the program.
std::string_view report_template() noexcept;

/// The page with a block of data in the place of the template's one comment `<!--condyle-data-->`: compressed
/// (zlib, RFC 1950) and in base64, so that nothing in it can be markup. Throws std::logic_error for a template
/// without that place, or with two.
std::string page_with(std::string_view page_template, std::string_view block);

}  // namespace condyle::io
