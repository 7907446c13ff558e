#include "io/report/page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <stdexcept>

#include "io/file/deflate.hpp"
#include "io/file/output_file.hpp"
#include "io/report/data_block.hpp"
#include "io/report/report.hpp"
#include "io/result/provenance_forms.hpp"
#include "io/result/sample_files.hpp"

namespace condyle::io {
namespace {

constexpr std::string_view place = "<!--condyle-data-->";

std::string base64(std::string_view bytes) {
  constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  out.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t at = 0; at < bytes.size(); at += 3) {
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - at);
    std::uint32_t three = 0;
    for (std::size_t i = 0; i < 3; ++i)
      three = three << 8 | (i < count ? static_cast<unsigned char>(bytes[at + i]) : 0);
    for (std::size_t i = 0; i < 4; ++i) out += i <= count ? digits[three >> (18 - 6 * i) & 63] : '=';
  }
  return out;
}

/// An element of bytes, compressed, so that nothing in it can be markup.
std::string stored(std::string_view attribute, std::string_view bytes) {
  return fmt::format("<script type=\"application/octet-stream\" {}>{}</script>", attribute,
                     base64(deflated(bytes)));
}

/// The template with a text in its one place.
std::string filled(std::string_view page_template, const std::string& text) {
  const std::size_t at = page_template.find(place);
  if (at == page_template.npos || page_template.find(place, at + 1) != page_template.npos)
    throw std::logic_error("the template of the report does not have exactly one place for its data");
  return fmt::format("{}{}{}", page_template.substr(0, at), text, page_template.substr(at + place.size()));
}

}  // namespace

std::string page_with(std::string_view page_template, std::string_view block) {
  return filled(page_template, stored("id=\"condyle-data\"", block));
}

std::string report_html(const Report& report) {
  return io::page_with(io::report_template(), io::data_block(report));
}

void check_report_file(const std::filesystem::path& path, const Provenance* from) {
  io::check_output_file(path, io::files_read(from),
                        {"a page", {".html", ".htm"}, "; print it to PDF from a browser"});
}

void write_report(const std::filesystem::path& path, const Report& report) {
  if (report.rom) check_report_file(path, report.rom->provenance);
  if (report.before && report.before->rom) check_report_file(path, report.before->rom->provenance);
  io::write_output_file(path, report_html(report));
}

std::string empty_report_html() {
  std::string files(place);
  for (const auto& [name, bytes] :
       sample_hip_files(sample::sample_hip({}, sample::Scenario::one), Side::right))
    files += stored(fmt::format("data-sample=\"{}\"", name), bytes);
  return filled(io::report_template(), files);
}

void write_empty_report(const std::filesystem::path& path) {
  check_report_file(path, nullptr);
  io::write_output_file(path, empty_report_html());
}

}  // namespace condyle::io
