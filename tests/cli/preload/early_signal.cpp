#include <csignal>
#include <cstdlib>

/// Preloaded before a program: a library that gets the signal CONDYLE_SIGNAL when it starts, as the program's own libraries do before
/// main().

namespace {

[[gnu::constructor]] void raise_when_loaded() {
  if (const char* const signal = std::getenv("CONDYLE_SIGNAL")) std::raise(std::atoi(signal));
}

}  // namespace
