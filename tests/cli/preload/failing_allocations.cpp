#include <dlfcn.h>
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <new>
#include <string>

/// Preloaded before a program: runs its main() again and again, each time in a process of its own, with another allocation by
/// operator new failing. What libraries written in C take by malloc() is left to them: HDF5, zlib and oneTBB's own pool end
/// the process themselves, or fail as a full disk does. Static initialisation is over when counting begins: before main()
/// nothing could catch the failure, so no program can answer for it.
///
///     CONDYLE_FAIL   "FIRST STEP LAST once" or "... on": which allocation fails, alone or with all after it; 0 is none. "... end": there the
///                    program is ended, as HDF5 does
///     CONDYLE_RESET  a shell's command before each run
///     CONDYLE_CHECK  one after it, whose exit code is kept
///     CONDYLE_LOG    gets of each run a line "N STATUS ASKED LIVE CHECK": N, the exit code (or -signal), how many blocks were
///                    asked for, how many were live at the end (both -1 where main() did not return); standard output and
///                    error go into LOG.N.out and LOG.N.err
///
/// When an allocation of that number was never asked for, that run is the last.

namespace {

std::atomic<bool> counting = false, has_failed = false;
std::atomic<long> asked = 0, live = 0;
long first_to_fail = 0;
bool goes_on = false, ends = false;

bool fails() noexcept {
  if (!counting) return false;
  const long number = ++asked;
  if (first_to_fail == 0 || number < first_to_fail || (has_failed && !goes_on)) return false;
  has_failed = true;
  if (ends) std::exit(EXIT_FAILURE);
  return true;
}

void* taken(std::size_t bytes, std::size_t alignment) noexcept {
  if (fails()) return nullptr;
  void* block = nullptr;
  if (alignment <= alignof(std::max_align_t))
    block = std::malloc(bytes == 0 ? 1 : bytes);
  else if (::posix_memalign(&block, alignment, bytes) != 0)
    block = nullptr;
  if (block != nullptr && counting) ++live;
  return block;
}

void* taken_or_thrown(std::size_t bytes, std::size_t alignment) {
  void* block = taken(bytes, alignment);
  if (block == nullptr) throw std::bad_alloc();
  return block;
}

void given_back(void* block) noexcept {
  if (block != nullptr && counting) --live;
  std::free(block);
}

constexpr std::size_t plain = alignof(std::max_align_t);

}  // namespace

void* operator new(std::size_t n) {
  return taken_or_thrown(n, plain);
}
void* operator new[](std::size_t n) {
  return taken_or_thrown(n, plain);
}
void* operator new(std::size_t n, std::align_val_t a) {
  return taken_or_thrown(n, static_cast<std::size_t>(a));
}
void* operator new[](std::size_t n, std::align_val_t a) {
  return taken_or_thrown(n, static_cast<std::size_t>(a));
}
void* operator new(std::size_t n, const std::nothrow_t&) noexcept {
  return taken(n, plain);
}
void* operator new[](std::size_t n, const std::nothrow_t&) noexcept {
  return taken(n, plain);
}
void* operator new(std::size_t n, std::align_val_t a, const std::nothrow_t&) noexcept {
  return taken(n, static_cast<std::size_t>(a));
}
void* operator new[](std::size_t n, std::align_val_t a, const std::nothrow_t&) noexcept {
  return taken(n, static_cast<std::size_t>(a));
}
void operator delete(void* block) noexcept {
  given_back(block);
}
void operator delete[](void* block) noexcept {
  given_back(block);
}
void operator delete(void* block, std::size_t) noexcept {
  given_back(block);
}
void operator delete[](void* block, std::size_t) noexcept {
  given_back(block);
}
void operator delete(void* block, std::align_val_t) noexcept {
  given_back(block);
}
void operator delete[](void* block, std::align_val_t) noexcept {
  given_back(block);
}
void operator delete(void* block, std::size_t, std::align_val_t) noexcept {
  given_back(block);
}
void operator delete[](void* block, std::size_t, std::align_val_t) noexcept {
  given_back(block);
}
void operator delete(void* block, const std::nothrow_t&) noexcept {
  given_back(block);
}
void operator delete[](void* block, const std::nothrow_t&) noexcept {
  given_back(block);
}
void operator delete(void* block, std::align_val_t, const std::nothrow_t&) noexcept {
  given_back(block);
}
void operator delete[](void* block, std::align_val_t, const std::nothrow_t&) noexcept {
  given_back(block);
}

namespace {

using Main = int (*)(int, char**, char**);
Main program = nullptr;

/// State that a run and the loop around it share.
struct Seen {
  long asked, live;
};

void redirect(int stream, const std::string& path) {
  const int file = ::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  if (file < 0 || ::dup2(file, stream) < 0) ::_exit(98);
  ::close(file);
}

int one_run(int argc, char** argv, char** environment, const std::string& log, long number, Seen* seen) {
  redirect(STDOUT_FILENO, log + "." + std::to_string(number) + ".out");
  redirect(STDERR_FILENO, log + "." + std::to_string(number) + ".err");
  first_to_fail = number;
  counting = true;
  const int code = program(argc, argv, environment);
  counting = false;
  *seen = {asked, live};
  std::fflush(nullptr);
  return code;
}

int all_runs(int argc, char** argv, char** environment) {
  const char *which = std::getenv("CONDYLE_FAIL"), *log = std::getenv("CONDYLE_LOG"),
             *reset = std::getenv("CONDYLE_RESET"), *check = std::getenv("CONDYLE_CHECK");
  if (which == nullptr || log == nullptr || reset == nullptr || check == nullptr)
    return program(argc, argv, environment);
  // The shell that resets is not preloaded.
  ::unsetenv("LD_PRELOAD");
  long first = 0, step = 1, last = 0;
  char mode[8] = {};
  if (std::sscanf(which, "%ld %ld %ld %7s", &first, &step, &last, mode) != 4) return 97;
  goes_on = std::string(mode) == "on", ends = std::string(mode) == "end";
  auto* seen = static_cast<Seen*>(
      ::mmap(nullptr, sizeof(Seen), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0));
  std::FILE* lines = std::fopen(log, "w");
  if (seen == MAP_FAILED || lines == nullptr) return 97;
  for (long number = first; number <= last; number += step) {
    if (std::system(reset) != 0) return 97;
    *seen = {-1, -1};
    std::fflush(nullptr);
    const pid_t child = ::fork();
    if (child == 0) ::_exit(one_run(argc, argv, environment, log, number, seen));
    int status = 0;
    ::waitpid(child, &status, 0);
    const int code = WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
    const int checked = std::system(check);
    std::fprintf(lines, "%ld %d %ld %ld %d\n", number, code, seen->asked, seen->live, WEXITSTATUS(checked));
    if (seen->asked >= 0 && seen->asked < number) break;
  }
  std::fclose(lines);
  return 0;
}

}  // namespace

/// Called by a program's start, before it calls main().
extern "C" int __libc_start_main(Main main, int argc, char** argv, void (*init)(), void (*fini)(),
                                 void (*rtld_fini)(), void* stack_end) {
  program = main;
  using Start = int (*)(Main, int, char**, void (*)(), void (*)(), void (*)(), void*);
  const auto start = reinterpret_cast<Start>(::dlsym(RTLD_NEXT, "__libc_start_main"));
  return start(all_runs, argc, argv, init, fini, rtld_fini, stack_end);
}
