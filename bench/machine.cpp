#include "machine.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <cstdlib>
#include <ctime>
#include <fstream>
#include <thread>

#include "commit.hpp"

namespace bench {
namespace {

/// The value of the first line of /proc/cpuinfo with that name; "unknown" where there is none.
std::string cpu_info(const std::string& name) {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);) {
    const auto colon = line.find(':');
    if (colon == std::string::npos || line.substr(0, line.find_last_not_of(" \t", colon - 1) + 1) != name)
      continue;
    const auto value = line.find_first_not_of(' ', colon + 1);
    if (value != std::string::npos) return line.substr(value);
  }
  return "unknown";
}

}  // namespace

std::vector<std::pair<std::string, std::string>> describe_machine() {
  return {
      {"processor", fmt::format("{} (family {}, model {})", cpu_info("model name"), cpu_info("cpu family"),
                                cpu_info("model"))},
      {"threads", fmt::format("{}", std::thread::hardware_concurrency())},
      {"compiler", CONDYLE_BENCH_COMPILER},
      {"commit", CONDYLE_COMMIT},
      {"date", fmt::format("{:%Y-%m-%d %H:%M} UTC", fmt::gmtime(std::time(nullptr)))},
  };
}

double load_average() {
  double average = 0;
  return getloadavg(&average, 1) == 1 ? average : 0;
}

}  // namespace bench
