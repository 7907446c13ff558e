#include <fcntl.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <thread>

#include "command.hpp"

/// The command's effects on files that it was not requested to replace, and its reaction to unusual names and files.

namespace condyle::test {
namespace {

using namespace std::chrono_literals;

std::string repeated(std::string_view what, int times) {
  std::string text;
  for (int i = 0; i < times; ++i) text += what;
  return text;
}

class Files : public ArmAndPost {
 protected:
  void SetUp() override {
    ArmAndPost::SetUp();
    for (const char* name : {"fixed.vtp", "bearing.vtp"}) io::write_vtp(here / name, post, {}, {});
    io::write_vtp(here / "mobile.vtp", arm, {}, {});
  }
  std::map<std::string, std::string> all_files() const {
    std::map<std::string, std::string> files;
    for (const auto& entry : fs::recursive_directory_iterator(here))
      files[entry.path().string()] =
          entry.is_regular_file() ? io::read_whole_file(entry.path()) : std::string("no file");
    return files;
  }
};

TEST_F(Files, ThatWereReadAreNeverWrittenOver) {
  write("hips.csv", "id,joint\na,joint.toml\nb,joint.toml\n");
  write("curves.csv", "time,flexion_deg\n0,0\n1,20\n");
  write("squat.csv", "time,flexion_deg\n0,0\n1,20\n");
  write("contacts.csv", "time,force_x_n,force_y_n,force_z_n\n0,0,1,0\n1,0,1,0\n");
  write("vtp.toml", text_of_joint({.fixed = "fixed.vtp"}));
  write("bearing.toml", text_of_joint({.fixed = "bearing.vtp"}));
  write("columns.csv", text_of_joint({}));
  write("odd.csv", "id,joint\na,columns.csv\n");
  write("joint.png", text_of_joint({}));
  write("depth.json", "1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1\n");
  fs::create_hard_link(here / "joint.toml", here / "hard.html");
  fs::create_symlink("arm.ply", here / "soft.html");
  fs::create_directory(here / "linked");
  fs::create_symlink("../hips.csv", here / "linked/limits.csv");
  const std::string layers = " --e 10 --nu 0.4 --thickness 3 ";
  const std::map<std::string, std::string> named = {
      {"study hips.csv --out .", "./hips.csv"},
      {"study hips.csv --out . --shard 1/2", "./hips.csv"},
      {"study hips.csv --out linked", "linked/limits.csv"},
      {"study odd.csv --out .", "./columns.csv"},
      {"motion joint.toml --motion curves.csv --out .", "./curves.csv"},
      {"motion joint.toml --motion squat.csv --loads contacts.csv --out ." + layers, "./contacts.csv"},
      {"depth vtp.toml --out .", "./fixed.vtp"},
      {"depth joint.toml --matrix depth.json --out .", "./depth.json"},
      {"load vtp.toml --out ." + layers, "./fixed.vtp"},
      {"rom bearing.toml --out .", "./bearing.vtp"},
      {"report joint.toml --out post.ply", "post.ply"},
      {"report joint.toml --out joint.toml", "joint.toml"},
      {"report joint.toml --out hard.html", "hard.html"},
      {"report joint.toml --out soft.html", "soft.html"},
      {"report joint.toml --motion curves.csv --out curves.csv", "curves.csv"},
      {"picture joint.png --out joint.png", "joint.png"},
      {"inspect post.ply --out .", "./post.ply"},
  };
  const auto before = all_files();
  for (const auto& [arguments, name] : named) {
    const Ran ran = run(arguments);
    EXPECT_EQ(ran.exit_code, 3) << arguments;
    EXPECT_EQ(ran.out, "") << arguments;
    EXPECT_EQ(without_notes(ran.err),
              "condyle: " + name + ": is read for this answer, which would be written over it\n")
        << arguments;
    EXPECT_EQ(all_files(), before) << arguments;
  }
  expect_refused(3, "init post.ply arm.ply -o joint.toml", "joint.toml: is there already");
  EXPECT_EQ(all_files(), before);
  // Beside them there is room.
  done("study hips.csv --out out");
  done("depth vtp.toml --out out");
}

TEST_F(Files, OfAStudyAreNotWrittenOverByItsMerge) {
  write("table.csv", "id,joint\na,joint.toml\nb,joint.toml\n");
  for (const char* shard : {"1/2", "2/2"}) done(std::string("study table.csv --out out --shard ") + shard);
  fs::copy_file(here / "table.csv", here / "out/hips.csv");
  const auto before = all_files();
  expect_refused(3, "merge out", "condyle: out/hips.csv: is the table of this study");
  fs::remove(here / "out/hips.csv");
  fs::create_hard_link(here / "out/shards/1_of_2/hips.csv", here / "out/hips.csv");
  expect_refused(3, "merge out", "condyle: out/hips.csv: is read for this answer");
  fs::remove(here / "out/hips.csv");
  done("merge out");
}

TEST_F(Files, ThatAreFifosAreWrittenIntoOrRefused) {
  const fs::path pipe = here / "pipe.png", limits = here / "out/limits.csv";
  fs::create_directory(here / "out");
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  ASSERT_EQ(::mkfifo(limits.c_str(), 0600), 0);
  for (const std::string command : {"report", "picture"}) {
    std::string got;
    std::thread reader([&] {
      std::ifstream in(pipe, std::ios::binary);
      got.assign(std::istreambuf_iterator<char>(in), {});
    });
    const Ran ran = run(command + " joint.toml --out pipe.png");
    if (ran.exit_code != 0) ::close(::open(pipe.c_str(), O_WRONLY | O_NONBLOCK));  // lets the reader go
    reader.join();
    EXPECT_EQ(ran.exit_code, 0) << ran.err;
    EXPECT_GT(got.size(), 1000u) << command;
    EXPECT_TRUE(fs::is_fifo(pipe)) << command;
  }
  expect_refused(3, "rom joint.toml --out out",
                 "condyle: out/limits.csv: is no regular file and is not replaced");
  EXPECT_TRUE(fs::is_fifo(limits));
  EXPECT_EQ(count_entries(here / "out"), 1u);
}

/// One like /dev/null, in the folder of this test: nothing else is written to.
TEST_F(Files, ThatAreDevicesAreWrittenInto) {
  const fs::path device = here / "nothing";
  if (::mknod(device.c_str(), S_IFCHR | 0600, ::makedev(1, 3)) != 0)
    GTEST_SKIP() << "only root makes devices, where the file system has them";
  if (::access(device.c_str(), W_OK) != 0) GTEST_SKIP() << "devices cannot be opened here";
  const Ran ran = run("report joint.toml --out nothing");
  struct stat status {};
  ASSERT_EQ(::lstat(device.c_str(), &status), 0);
  EXPECT_TRUE(S_ISCHR(status.st_mode));
  EXPECT_TRUE(ran.exit_code == 0 || ran.exit_code == 3)
      << ran.err;  // 3 where devices of this file system are off
}

TEST_F(Files, UnderALinkAreReplacedWhereTheyLie) {
  fs::create_directory(here / "elsewhere");
  write("elsewhere/page.html", "The Condyle authors, earlier");
  fs::create_symlink("elsewhere/page.html", here / "link.html");
  done("report joint.toml --out link.html");
  EXPECT_TRUE(fs::is_symlink(here / "link.html"));
  EXPECT_GT(fs::file_size(here / "elsewhere/page.html"), 1000u);
  done("report joint.toml --out /dev/stdout");
  EXPECT_TRUE(fs::exists("/dev/stdout"));
}

TEST_F(Files, WithWholeNumbersBeyondTwoToThe53rdAreRefused) {
  const std::string good = text_of_joint({});
  const auto with_centre = [&](const std::string& x) {
    std::string text = good;
    text.replace(text.find("[0, 0, 0]"), 9, "[" + x + ", 0, 0]");
    write("big.toml", text);
    return run("frame big.toml");
  };
  for (const char* x : {"9007199254740993", "-9007199254740993", "9223372036854775807", "0x20000000000001"})
    expect_refusal(
        with_centre(x), 3,
        "condyle: big.toml: line 11: frame.centre: is a whole number beyond 2^53 that no double holds", x);
  write("seed.toml", good + "[uncertainty]\ncentre = 9007199254740993\n");
  expect_refused(3, "frame seed.toml", "seed.toml: line 15: uncertainty.centre: is a whole number");
}

TEST_F(Files, NestedDeepAreRefusedWithTheirLine) {
  const std::string good = text_of_joint({});
  const auto expect_deep = [&](const std::string& more, int line) {
    write("deep.toml", good + more);
    expect_refusal(run("frame deep.toml"), 3,
                   "condyle: deep.toml: line " + std::to_string(line) +
                       ": keys, lists and tables may be nested 16 deep, not deeper",
                   more.substr(0, 40));
  };
  expect_deep("a" + repeated(".a", 14999) + " = 1\n", 14);
  expect_deep("x = '''\n\n'''\n[\"a\"" + repeated(" . \"a\"", 15000) + "]\n", 17);
  expect_deep("x = " + repeated("[", 15000) + repeated("]", 15000) + "\n", 14);
  expect_deep("x = " + repeated("{a = ", 15000) + "1" + repeated("}", 15000) + "\n", 14);
  expect_deep("x = [\n" + repeated("[\n", 16) + repeated("]", 17) + "\n", 30);
  // Sixteen levels are read, and brackets and points of texts are none.
  write("text.toml", text_of_joint({.more = "# " + repeated("[", 99) + "\n[reference_pose]\nflexion = 0\n"}));
  done("frame text.toml");
  write("unknown.toml", good + "a" + repeated(".a", 15) + " = \"" + repeated("[.\\\"{", 40) + "\"\n");
  expect_refused(3, "frame unknown.toml", "unknown key");
  // A study goes on without that joint.
  write("deep.toml", good + "a" + repeated(".a", 14999) + " = 1\n");
  write("two.csv", "id,joint\na,joint.toml\nb,deep.toml\n");
  EXPECT_EQ(run("study two.csv --out out").out, "1 answered, 1 failed\n");
  // A record that somebody else wrote.
  fs::create_directory(here / "out/shards");
  fs::create_directory(here / "out/shards/1_of_1");
  for (const char* name : {"limits.csv", "hips.csv", "failures.csv", "columns.csv", "study.h5"})
    fs::copy_file(here / "out" / name, here / "out/shards/1_of_1" / name);
  std::string record = text_of("out/study.json");
  record.insert(record.find("\"options\": {") + 12,
                "\"x\": " + repeated("[", 100000) + repeated("]", 100000) + ",");
  write("out/shards/1_of_1/study.json", record);
  expect_refused(3, "merge out", "out: 1 of 1 shards is missing or not whole: 1");
}

/// C0, C1 as UTF-8 and as bare bytes, and what turns the direction of writing.
TEST_F(Files, WithControlCharactersInTheirNamesSayNothingToATerminal) {
  const std::string obeyed = "\x1b[31m\xc2\x9b\x31m\xe2\x80\xae\x9b\x7f";
  const std::string name = "post" + obeyed + ".ply";
  fs::copy_file(here / "post.ply", here / name);
  const auto expect_plain = [&](const std::string& text) {
    for (const std::string bad : {"\x1b", "\xc2\x9b", "\xe2\x80\xae", "\x9b", "\x7f"})
      EXPECT_FALSE(says(text, bad));
  };
  const auto all_of = [&](const std::string& arguments) {
    const Ran ran = run(arguments);
    return ran.out + ran.err;
  };
  expect_plain(all_of("inspect '" + name + "'"));
  expect_plain(all_of("inspect '" + name + "' --json"));
  expect_plain(all_of("inspect '" + name + "x'"));
  expect_plain(all_of("depth '" + name + "'"));
  expect_plain(all_of("depth joint.toml --out '" + name + ".d'"));
  fs::copy_file(here / "post.ply", here / "post\xc2\x9b.ply");
  const Ran named = run("inspect 'post\xc2\x9b.ply' --json");
  EXPECT_EQ(Json::parse(named.out)["meshes"][0]["file"], "post\xc2\x9b.ply") << named.out;
  // In a joint file no text has them; a table's ids come back in notes.
  write("esc.toml", text_of_joint({.more = "[[motion]]\nname = \"a\\u001b[31m\\nb\"\nvary = \"flexion\"\n"
                                           "range = [0, 90]\n"}));
  expect_refused(3, "frame esc.toml", "esc.toml: line 15: motion[0].name: must have no control character");
  write("flip.toml", text_of_joint({}));
  write("ids.csv", "id,joint\na" + std::string("\x1b[31m\xc2\x9b") + ",flip.toml\nb,nothere\x1b.toml\n");
  expect_plain(all_of("study ids.csv --out out"));
}

TEST_F(Files, InLatin1AreRefusedWithTheirLine) {
  write("hips.csv", "id,joint,town\na,joint.toml,Ulm\nb,joint.toml,K\xf6ln\n");
  expect_refused(3, "study hips.csv --out out", "condyle: hips.csv: line 3: is not UTF-8 (Latin-1?)");
  write("walk.csv", "time,flexion_deg,sp\xe4t\n0,0,1\n1,20,1\n");
  expect_refused(3, "motion joint.toml --motion walk.csv",
                 "condyle: walk.csv: line 1: column 'sp?t' is not UTF-8 (Latin-1?)");
  write("hips.csv", "id,joint,town\na,joint.toml,Ulm\nb,joint.toml,K\xc3\xb6ln\n");
  EXPECT_EQ(run("study hips.csv --out out").out, "2 answered, 0 failed\n");
}

TEST_F(Files, ThatAreRefusedAreSoBeforeAnyNote) {
  TriMesh open = arm;
  open.triangles.pop_back();
  io::write_mesh(here / "open.ply", open);
  write("open.toml", text_of_joint({.mobile = "open.ply"}));
  const Ran ran = run("depth open.toml --pose '1.0000001 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1'");
  EXPECT_EQ(ran.exit_code, 4);
  EXPECT_TRUE(ran.err.starts_with("condyle: open.ply: ")) << ran.err;
}

class Signalled : public Files {
 protected:
  pid_t start(const std::string& arguments, const std::vector<int>& ignored = {}) const {
    return start_condyle(here, arguments, here / "err.txt", ignored);
  }
  static bool is_running(pid_t child) { return ::waitpid(child, nullptr, WNOHANG) == 0; }
  bool wait_for(const fs::path& path) const {
    for (int i = 0; i < 3000 && !fs::exists(path); ++i) std::this_thread::sleep_for(10ms);
    return fs::exists(path);
  }
  /// More hips than anybody waits for; its folder shows when it has begun to listen.
  const std::string long_cohort = "sample cohort --n 100000 --meshes --out cohort --threads 1";
};

TEST_F(Signalled, ByWhatTheParentIgnoresGoOn) {
  const pid_t child = start(long_cohort, {SIGINT, SIGHUP});
  ASSERT_TRUE(wait_for(here / "cohort/hips"));
  for (const int signal : {SIGINT, SIGHUP, SIGINT}) {
    ::kill(child, signal);
    std::this_thread::sleep_for(100ms);
  }
  EXPECT_TRUE(is_running(child));
  ::kill(child, SIGTERM);
  EXPECT_EQ(end_of(child), 130) << io::read_whole_file(here / "err.txt");
}

TEST_F(Signalled, LeaveNoTemporaryFolder) {
  for (const int signal : {SIGTERM, SIGHUP, SIGINT}) {
    const pid_t child = start(long_cohort);
    ASSERT_TRUE(wait_for(here / "cohort/hips"));
    std::this_thread::sleep_for(30ms);
    ::kill(child, signal);  // noted, while a hip is made
    std::this_thread::sleep_for(1ms);
    ::kill(child, signal);  // ends it
    EXPECT_EQ(end_of(child), 130) << signal;
    EXPECT_FALSE(has_temporary(here)) << signal;
    fs::remove_all(here / "cohort");
  }
}

/// A FIFO holds the writer at its work, so that the signal comes while results are being written.
TEST_F(Signalled, WhileTheyWriteLeaveWhatWasThere) {
  const fs::path pipe = here / "pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  for (const int signal : {SIGTERM, SIGHUP, SIGINT}) {
    const pid_t child = start("report joint.toml --out pipe");
    const int reader = ::open(pipe.c_str(), O_RDONLY);
    char byte;
    ASSERT_EQ(::read(reader, &byte, 1), 1);  // the rest of the page fills the pipe
    ::kill(child, signal);
    EXPECT_EQ(end_of(child), 130) << signal;
    ::close(reader);
    EXPECT_TRUE(is_one_error_line(io::read_whole_file(here / "err.txt")));
    EXPECT_TRUE(fs::is_fifo(pipe));
  }
}

}  // namespace
}  // namespace condyle::test
