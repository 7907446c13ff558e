#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <new>

#include "io/file/h5_image.hpp"
#include "support/test.hpp"

/// HDF5 does not survive an allocation that fails: memory that does not suffice has to end before it.

namespace condyle {
namespace {

#if defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define CONDYLE_OWN_MALLOC
#endif
#endif

enum class Ending : int { whole = 0, out_of_memory = 5, refused = 3 };

/// Writes an image with so many bytes of address space more than this process has, all of which it has used up.
Ending written_within(std::size_t bytes) {
  std::size_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  const std::vector<double> values(20'000, 1.5);
  const std::vector<std::string> texts(5'000, "femur");
  const rlim_t used = pages * static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
  rlimit limit{used, used + bytes};
  if (::setrlimit(RLIMIT_AS, &limit) != 0) return Ending::refused;
  for (std::size_t block = std::size_t{1} << 24; block >= 64; block /= 2)
    for (void* volatile taken = std::malloc(block); taken != nullptr;) taken = std::malloc(block);
  limit.rlim_cur = limit.rlim_max;
  if (::setrlimit(RLIMIT_AS, &limit) != 0) return Ending::refused;
  try {
    io::H5Image file;
    file.group("/limits");
    for (int i = 0; i < 30; ++i) {
      const std::string path = "/limits/c" + std::to_string(i);
      if (i % 2)
        file.texts(path, texts);
      else
        file.numbers(path, values, values.size(), 0);
      file.attribute(path, "unit", "deg");
    }
    return file.bytes().size() > values.size() * sizeof(double) ? Ending::whole : Ending::refused;
  } catch (const std::bad_alloc&) {
    return Ending::out_of_memory;
  } catch (const FileError&) {
    return Ending::refused;
  }
}

TEST(H5Memory, ThatDoesNotSufficeEndsBeforeHdf5IsAskedForIt) {
#ifdef CONDYLE_OWN_MALLOC
  GTEST_SKIP() << "a sanitizer needs all of the address space";
#endif
  int whole = 0, out_of_memory = 0;
  // The heap of a process that has run for long takes more: what its image leaves behind as it grows is not given back.
  for (std::size_t room = 0; room <= std::size_t{256} << 20; room += std::size_t{4} << 20) {
    const pid_t child = ::fork();
    ASSERT_GE(child, 0);
    if (child == 0) ::_exit(static_cast<int>(written_within(room)));
    int status = 0;
    ASSERT_EQ(::waitpid(child, &status, 0), child);
    ASSERT_TRUE(WIFEXITED(status)) << "ended by signal " << WTERMSIG(status) << " within " << room
                                   << " bytes";
    whole += WEXITSTATUS(status) == static_cast<int>(Ending::whole);
    out_of_memory += WEXITSTATUS(status) == static_cast<int>(Ending::out_of_memory);
    EXPECT_NE(WEXITSTATUS(status), static_cast<int>(Ending::refused)) << room;
  }
  EXPECT_GT(whole, 10);
  EXPECT_GT(out_of_memory, 10);
}

}  // namespace
}  // namespace condyle
