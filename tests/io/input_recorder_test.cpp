#include "io/file/input_recorder.hpp"

#include <chrono>
#include <future>
#include <thread>

#include "condyle/io/mesh_file.hpp"
#include "core/thread_limit.hpp"
#include "io/file/environment.hpp"
#include "io/file/input_file.hpp"
#include "io/file/output_file.hpp"
#include "io/file/read_pair.hpp"
#include "io/image/byte_source.hpp"
#include "support/test.hpp"

/// What an answer read is recorded by the functions that read.

namespace condyle::test {
namespace {

namespace fs = std::filesystem;
using io::Input;
using io::InputRecorder;

class Recorded : public ::testing::Test {
 protected:
  fs::path write(const std::string& name, const std::string& text) const { return folder.file(name, text); }
  static std::string digest(const std::string& text) { return io::digest_of(text).sha256; }

  const TemporaryFolder folder;
};

TEST_F(Recorded, IsEveryFileWithItsContentsOnceAndInOrder) {
  const fs::path a = write("a", "one"), b = write("b", "two"), none = folder / "none";
  const InputRecorder read;
  io::read_whole_file(b);
  EXPECT_THROW(io::read_whole_file(none), FileError);
  const io::ByteSource voxels(a);
  io::FileDigest of_b;
  io::read_whole_file(b, &of_b);
  EXPECT_EQ(of_b.sha256, digest("two"));
  const std::vector<Input> expected = {{Input::Kind::file, b, digest("two")},
                                       {Input::Kind::file, none, "none"},
                                       {Input::Kind::file, a, digest("one")}};
  EXPECT_EQ(read.inputs(), expected);
  for (const Input& input : expected) {
    EXPECT_EQ(io::state_now(input.kind, input.path), input.state) << input.path;
    EXPECT_EQ(io::input_in(io::text_of(input)), input);
  }
  write("none", "");
  EXPECT_EQ(io::state_now(Input::Kind::file, none), digest(""));
  EXPECT_FALSE(read.passing_failure());
}

TEST_F(Recorded, OfTwoReadAtTheSameTimeIsAsOfOneAfterTheOther) {
  const fs::path a = write("a", "one"), b = write("b", "two"), none = folder / "none";
  const auto names = [](const InputRecorder& read) {
    std::vector<fs::path> paths;
    for (const Input& input : read.inputs()) paths.push_back(input.path);
    return paths;
  };
  const InputRecorder around;
  // The first waits for the second.
  std::promise<void> second_read;
  {
    const InputRecorder read;
    io::read_pair(
        [&] {
          if (core::threads_allowed() > 1) second_read.get_future().wait_for(std::chrono::seconds(5));
          io::read_whole_file(a);
        },
        [&] { io::read_whole_file(b), second_read.set_value(); });
    EXPECT_EQ(names(read), (std::vector<fs::path>{a, b}));
  }
  EXPECT_EQ(names(around), (std::vector<fs::path>{a, b}));
  {
    const InputRecorder read;
    EXPECT_THROW(io::read_pair([&] { io::read_whole_file(none); }, [&] { io::read_whole_file(b); }),
                 FileError);
    EXPECT_EQ(names(read), (std::vector<fs::path>{none}));
  }
  {
    const InputRecorder read;
    EXPECT_THROW(io::read_pair([&] { io::read_whole_file(b); }, [&] { io::read_whole_file(none); }),
                 FileError);
    EXPECT_EQ(names(read), (std::vector<fs::path>{b, none}));
  }
}

TEST_F(Recorded, IsWhatWasLookedForAndTheEnvironment) {
  write("Bone.ply", "");
  ::setenv("CONDYLE_TEST_BONES", "here", 1);
  const InputRecorder read;
  EXPECT_EQ(io::entry_at(folder / "bone.ply"), io::EntryKind::none);
  EXPECT_EQ(io::names_like(folder.path(), "bone.ply"), (std::vector<std::string>{"Bone.ply"}));
  io::environment_variable("CONDYLE_TEST_BONES");
  const std::vector<Input> inputs = read.inputs();
  ASSERT_EQ(inputs.size(), 3u);
  const auto is_as_it_was = [&](std::size_t i) {
    return io::state_now(inputs[i].kind, inputs[i].path) == inputs[i].state;
  };
  for (std::size_t i = 0; i < 3; ++i) EXPECT_TRUE(is_as_it_was(i)) << i;
  write("bone.ply", "");
  ::setenv("CONDYLE_TEST_BONES", "there", 1);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_FALSE(is_as_it_was(i)) << i;
  write("other.ply", "");
  EXPECT_EQ(io::state_now(Input::Kind::names, folder / "BONE.PLY"),
            io::state_now(Input::Kind::names, folder / "bone.ply"));
  ::unsetenv("CONDYLE_TEST_BONES");
}

TEST_F(Recorded, ThatChangedBetweenTwoLooksIsNothingThatIsThereLater) {
  const fs::path a = write("a", "one");
  const InputRecorder read;
  io::read_whole_file(a);
  write("a", "two");
  io::read_whole_file(a);
  ASSERT_EQ(read.inputs().size(), 1u);
  EXPECT_EQ(read.inputs()[0].state, io::changing_state);
}

TEST_F(Recorded, GoesOutwardsAndIntoThreadsThatEnterAndNowhereElse) {
  const fs::path a = write("a", "one"), b = write("b", "two"), c = write("c", "three");
  const InputRecorder outer;
  {
    const InputRecorder inner;
    io::read_whole_file(a);
    std::thread([&, in = InputRecorder::current()] {
      io::read_whole_file(c);
      const io::Recording entered(in);
      io::read_whole_file(b);
    }).join();
    EXPECT_EQ(inner.inputs().size(), 2u);
  }
  {
    const io::Recording none(nullptr);
    io::read_whole_file(c);
  }
  ASSERT_EQ(outer.inputs().size(), 2u);
  EXPECT_EQ(outer.inputs()[1].path, b);
}

TEST_F(Recorded, IsNeverWrittenOver) {
  const fs::path a = write("a", "one");
  fs::create_hard_link(a, folder / "linked");
  {
    const InputRecorder read(InputRecorder::Digests::left_out);
    const io::ByteSource voxels(a);
    for (const char* name : {"a", "linked"}) {
      EXPECT_THROW(io::check_output_file(folder / name), FileError);
      EXPECT_THROW(io::write_output_file(folder / name, "other"), FileError);
    }
    io::write_output_file(folder / "b", "other");
  }
  io::write_output_file(a, "other");
}

}  // namespace
}  // namespace condyle::test
