#include "io/file/csv_fields.hpp"
#include "support/test.hpp"

/// Texts as fields of CSV tables.

namespace condyle::test {
namespace {

std::string read_back(const std::string& field) {
  const std::string line = "first," + field + ",last";
  const io::Source source{line, "table.csv"};
  const std::vector<std::string> fields = io::csv_fields(line, 1, source);
  EXPECT_EQ(fields.size(), 3u) << field;
  return fields.size() == 3 ? fields[1] : std::string();
}

TEST(CsvField, IsPlainIfNothingNeedsAQuote) {
  for (const char* text : {"", "femur", "a'b", "a=b", "-", "+", "=", "'", "C:\\users\\a", "-1.5", "+2",
                           "-1e-300", "\xc3\xa9", "10 % - 20 %"})
    EXPECT_EQ(io::csv_field(text), text);
  EXPECT_EQ(io::csv_field("a,b"), "\"a,b\"");
  EXPECT_EQ(io::csv_field("a \"b\""), "\"a \"\"b\"\"\"");
  EXPECT_EQ(io::csv_field("#1"), "\"#1\"");
}

TEST(CsvField, OfANameThatASpreadsheetWouldComputeIsAText) {
  EXPECT_EQ(io::csv_field("=1+1"), "\"'=1+1\"");
  EXPECT_EQ(io::csv_field("+x"), "\"'+x\"");
  EXPECT_EQ(io::csv_field("-x"), "\"'-x\"");
  EXPECT_EQ(io::csv_field("@SUM(A1)"), "\"'@SUM(A1)\"");
  EXPECT_EQ(io::csv_field("-1.5a"), "\"'-1.5a\"");
}

TEST(CsvField, HasNoCharacterThatATerminalObeys) {
  EXPECT_EQ(io::csv_field("a\x1b[2J"), "\"a\\u001b[2J\"");
  EXPECT_EQ(io::csv_field("a\nb\r"), "\"a\\u000ab\\u000d\"");
  EXPECT_EQ(io::csv_field("\x7f\xc2\x9b\xe2\x80\xae"), "\"\\u007f\\u009b\\u202e\"");
  EXPECT_EQ(io::csv_field("a\\u001bb"), "\"a\\u005cu001bb\"");
}

TEST(CsvField, ReadBackIsTheTextAsItWas) {
  std::vector<std::string> texts = {"\\u005c", "\\\\u001b", "\\u0041", "\\u001", "\\u00zz", "\xe2\x80\xa8x"};
  const std::string pieces[] = {"=",    "+",  "-",       "@", "'", "\"",      ",",
                                "\x1b", "\t", "\\u001b", "x", "1", "\xc2\x85"};
  for (const std::string& a : pieces)
    for (const std::string& b : pieces)
      for (const std::string& c : pieces) texts.push_back(a + b + c);
  for (const std::string& text : texts)
    EXPECT_EQ(read_back(io::csv_field(text)), text) << io::csv_field(text);
}

}  // namespace
}  // namespace condyle::test
