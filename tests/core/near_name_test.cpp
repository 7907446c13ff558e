#include "core/near_name.hpp"
#include "support/test.hpp"

namespace condyle::core {
namespace {

const std::vector<std::string> names{"centre", "anterior", "superior", "fit_body", "fit_within"};

TEST(NearName, IsTheOneThatWasMeant) {
  EXPECT_EQ(near_name("center", names), "centre");
  EXPECT_EQ(near_name("centr", names), "centre");
  EXPECT_EQ(near_name("anteroir", names), "anterior");
  EXPECT_EQ(near_name("fit_bodie", names), "fit_body");
}

TEST(NearName, IsNoneWhereNoneIsNear) {
  for (const char* word : {"", "x", "landmarks", "exteriors_", "rim"})
    EXPECT_EQ(near_name(word, names), "") << word;
  EXPECT_EQ(near_name("ab", std::vector<std::string>{"cd", "abc"}), "abc");
  EXPECT_EQ(near_name("ab", std::vector<std::string>{"ad"}), "") << "half of it is another";
}

TEST(NearName, IsNoneOfVeryLongWords) {
  const std::string word(1'000'000, 'a');
  EXPECT_EQ(near_name(word, std::vector<std::string>{word + "b", "a"}), "");
}

TEST(NearName, IsAskedForInWords) {
  EXPECT_EQ(did_you_mean("center", std::vector<std::string>{"cent\nre"}), " (did you mean \"cent?re\"?)");
  EXPECT_EQ(did_you_mean("center", names), " (did you mean \"centre\"?)");
  EXPECT_EQ(did_you_mean("zzz", names), "");
}

}  // namespace
}  // namespace condyle::core
