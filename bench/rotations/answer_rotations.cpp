// condyle-answer-rotations METHOD QUERIES.csv: one line per query, 1 if the features meet and 0 if not; time on standard error.
//
// METHOD is events or search (the library's), chords=DEGREES or samples=DEGREES; angles prints where the library's events say that they first
// meet, in radians from the start, or none; placed prints the coordinates that all of these are asked about, z the axis and the motion at its
// start.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <exception>
#include <functional>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "rotations/rotation_methods.hpp"

namespace {

using Method = std::function<bool(const bench::RotationQuery&)>;

std::optional<Method> method_of(std::string_view word) {
  if (word == "events")
    return [](const auto& query) { return bench::first_contact_by_events(query).has_value(); };
  if (word == "search") return bench::meet_by_search;
  const std::size_t equals = word.find('=');
  if (equals == std::string_view::npos) return std::nullopt;
  const std::string number(word.substr(equals + 1));
  char* end = nullptr;
  const double step = std::strtod(number.c_str(), &end) * std::numbers::pi / 180;
  if (end == number.c_str() || *end != '\0' || !(step > 0)) return std::nullopt;
  const std::string_view name = word.substr(0, equals);
  if (name == "chords") return [step](const auto& query) { return bench::meet_by_chords(query, step); };
  if (name == "samples") return [step](const auto& query) { return bench::meet_by_samples(query, step); };
  return std::nullopt;
}

double processor_seconds() {
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

int answer(const Method& method, const char* path) {
  const auto queries = bench::read_rotation_queries(path);
  std::vector<char> answers;
  const double start = processor_seconds();
  for (const auto& query : queries) answers.push_back(method(query) ? '1' : '0');
  const double seconds = processor_seconds() - start;
  for (const char each : answers) std::printf("%c\n", each);
  const double count = static_cast<double>(std::max<std::size_t>(1, queries.size()));
  std::fprintf(stderr, "%.4g us per query\n", 1e6 * seconds / count);
  return EXIT_SUCCESS;
}

int print_angles(const char* path) {
  for (const auto& query : bench::read_rotation_queries(path)) {
    const auto angle = bench::first_contact_by_events(query);
    angle ? std::printf("%.17g\n", *angle) : std::printf("none\n");
  }
  return EXIT_SUCCESS;
}

int print_placed(const char* path) {
  for (const auto& query : bench::read_rotation_queries(path)) {
    for (const bench::Point& p : query.points) std::printf("%a %a %a ", p.x, p.y, p.z);
    std::printf("\n");
  }
  return EXIT_SUCCESS;
}

}  // namespace

int main(int count, char** words) {
  const std::string_view word = count == 3 ? words[1] : "";
  const auto method = method_of(word);
  if (!method && word != "angles" && word != "placed") {
    std::fprintf(stderr, "usage: %s events|search|angles|placed|chords=DEGREES|samples=DEGREES QUERIES.csv\n",
                 words[0]);
    return 2;
  }
  try {
    if (method) return answer(*method, words[2]);
    return word == "angles" ? print_angles(words[2]) : print_placed(words[2]);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 3;
  }
}
