#include "io/result/limit_fields.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <set>
#include <string>

#include "io/file/whole_file.hpp"
#include "rom_scene.hpp"

/// One description of a limit: what the pages say of its values is what the files hold.

namespace condyle::test {
namespace {

std::string page() {
  return io::read_whole_file(std::filesystem::path(CONDYLE_SOURCE_DIR) / "docs/formats-limits.md");
}

TEST(LimitFields, AreNamedOnce) {
  std::set<std::string> keys, columns;
  for (const io::LimitField& field : io::limit_fields()) {
    if (*field.key != 0) {
      EXPECT_TRUE(keys.insert(field.key).second) << field.key;
      EXPECT_NE(*field.meaning, 0) << field.key;
    }
    for (const io::ResultColumn& column : io::columns_of(field, Anatomy::knee)) {
      EXPECT_TRUE(columns.insert(column.name).second) << column.name;
      EXPECT_FALSE(column.meaning.empty()) << column.name;
    }
  }
  EXPECT_GE(keys.size(), 20u);
  EXPECT_GE(columns.size(), 30u);
}

TEST(LimitFields, AreInThePageAsTheyAreInTheFiles) {
  std::string keys = "| key | value |\n|---|---|\n", columns = "| column | unit | value |\n|---|---|---|\n";
  for (const io::LimitField& field : io::limit_fields()) {
    if (*field.key != 0) keys += "| `" + std::string(field.key) + "` | " + field.meaning + " |\n";
    for (const io::ResultColumn& column : io::columns_of(field, Anatomy::hip))
      columns += "| `" + column.name + "` | " + column.unit + " | " + column.meaning + " |\n";
  }
  EXPECT_NE(page().find(keys), std::string::npos) << "docs/formats-limits.md, an element of motions:\n"
                                                  << keys;
  EXPECT_NE(page().find(columns), std::string::npos) << "docs/formats-limits.md, limits.csv:\n" << columns;
}

TEST(LimitFields, HaveAsManyTextsAsColumnsForAnyLimit) {
  const Joint joint = arm_and_post();
  motion::MotionLimit free;
  free.motion = {"own", JointAngle::adduction, RotationSense::negative, {}, Angle::degrees(40)};
  motion::MotionLimit contact = free;
  contact.end.reason = motion::LimitReason::contact;
  contact.end.contact = {{motion::FeatureKind::edge, 3, 17},
                         {motion::FeatureKind::face, 40},
                         {1, 2, 3},
                         {4, 5, 6},
                         motion::ContactKind::bearing};
  const std::vector<motion::MotionLimit> limits = {free, contact};
  const RangeAnswer answer{.joint = joint, .limits = limits};
  const io::RomResult result{joint, answer};
  for (std::size_t i = 0; i < limits.size(); ++i) {
    for (const io::LimitField& field : io::limit_fields()) {
      std::vector<std::string> texts;
      io::append_texts(texts, field, {result, i});
      EXPECT_EQ(texts.size(), io::columns_of(field, joint.anatomy).size()) << field.key << field.column;
    }
  }
}

}  // namespace
}  // namespace condyle::test
