#include "support/report_block.hpp"

#include <zlib.h>

namespace condyle::test {
namespace {

constexpr std::string_view opening = "<script type=\"application/octet-stream\" id=\"condyle-data\">";
constexpr std::string_view closing = "</script>";

void require(bool holds, const char* what) {
  if (!holds) throw std::runtime_error(std::string("report: ") + what);
}

std::string from_base64(std::string_view text) {
  constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  require(text.size() % 4 == 0, "base64 of four characters each");
  std::string bytes;
  unsigned bits = 0;
  int held = 0;
  for (const char character : text.substr(0, text.find('='))) {
    const std::size_t digit = digits.find(character);
    require(digit != digits.npos, "a character that is not of base64");
    bits = bits << 6 | static_cast<unsigned>(digit);
    held += 6;
    if (held >= 8) bytes += static_cast<char>(bits >> (held -= 8) & 0xffu);
  }
  return bytes;
}

std::string inflated(const std::string& bytes) {
  z_stream stream{};
  require(inflateInit(&stream) == Z_OK, "zlib");
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
  stream.avail_in = static_cast<uInt>(bytes.size());
  std::string out;
  int status = Z_OK;
  while (status == Z_OK) {
    std::vector<char> piece(1 << 20);
    stream.next_out = reinterpret_cast<Bytef*>(piece.data());
    stream.avail_out = static_cast<uInt>(piece.size());
    status = inflate(&stream, Z_NO_FLUSH);
    out.append(piece.data(), piece.size() - stream.avail_out);
  }
  const bool all_read = stream.avail_in == 0;
  inflateEnd(&stream);
  require(status == Z_STREAM_END && all_read, "a zlib stream and nothing behind it");
  return out;
}

std::uint32_t word(const std::string& bytes, std::size_t at) {
  std::uint32_t number;
  std::memcpy(&number, bytes.data() + at, sizeof number);
  return number;
}

}  // namespace

std::string data_element(const std::string& html) {
  const std::size_t begin = html.find(opening);
  require(begin != html.npos && html.find(opening, begin + 1) == html.npos, "one element with data");
  const std::size_t end = html.find(closing, begin);
  require(end != html.npos, "an end of the data");
  return html.substr(begin, end + closing.size() - begin);
}

ReportBlock report_block(const std::string& html) {
  const std::string element = data_element(html);
  const std::string block = inflated(from_base64(
      std::string_view(element).substr(opening.size(), element.size() - opening.size() - closing.size())));
  require(block.size() >= 16 && block.substr(0, 8) == std::string("CONDYLE\0", 8), "its first eight bytes");
  require(word(block, 8) == 1, "version 1");
  const std::size_t length = word(block, 12);
  require(length % 8 == 0 && 16 + length <= block.size(), "a length of the JSON");
  return {nlohmann::json::parse(block.substr(16, length)), block.substr(16 + length)};
}

}  // namespace condyle::test
