#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>
#include <random>
#include <string>

#include "fuzz/largest_allocation.hpp"
#include "fuzz/mesh_reader_promise.hpp"
#include "support/mesh_bytes.hpp"
#include "support/test_meshes.hpp"

namespace condyle {
namespace {

using Random = std::mt19937;  // the same numbers on every machine, unlike the distributions of <random>

std::size_t below(Random& random, std::size_t bound) {
  return bound == 0 ? 0 : random() % bound;
}

/// Damage as transport, other programs and malice do it: flipped bits, bytes replaced, cut, doubled or moved,
/// numbers made huge, negative or not numbers at all.
std::string mutated(std::string bytes, const std::string& other, Random& random) {
  static constexpr const char* nasty[] = {"-1",
                                          "0",
                                          "4294967295",
                                          "99999999999999999999",
                                          "nan",
                                          "-inf",
                                          "1e999",
                                          "9223372036854775807",
                                          "18446744073709551615",
                                          "2147483648",
                                          "<",
                                          ">",
                                          "\"",
                                          "\n",
                                          " ",
                                          "property",
                                          "</",
                                          "AppendedData",
                                          "=",
                                          "_"};
  const std::size_t changes = 1 + below(random, 4);
  for (std::size_t i = 0; i < changes && !bytes.empty(); ++i) {
    const std::size_t at = below(random, bytes.size());
    const std::size_t length = 1 + below(random, std::min<std::size_t>(16, bytes.size() - at));
    switch (below(random, 8)) {
      case 0:
        bytes[at] = static_cast<char>(bytes[at] ^ (1 << below(random, 8)));
        break;
      case 1:
        bytes[at] = static_cast<char>(random());
        break;
      case 2:
        bytes.resize(at);
        break;
      case 3:
        bytes.erase(at, length);
        break;
      case 4:
        bytes.insert(at, bytes.substr(below(random, bytes.size()), length));
        break;
      case 5:
        bytes.insert(at, nasty[below(random, std::size(nasty))]);
        break;
      case 6: {  // a whole number of the text
        const auto first = bytes.find_first_of("0123456789", at);
        if (first == std::string::npos) break;
        const auto last = std::min(bytes.find_first_not_of("0123456789", first), bytes.size());
        bytes.replace(first, last - first, nasty[below(random, std::size(nasty))]);
        break;
      }
      case 7:
        bytes = bytes.substr(0, at) + other.substr(below(random, other.size()));
        break;
    }
  }
  return bytes;
}

/// A format, and what writes files of it in every way.
struct Writer {
  const char* name;
  std::vector<test::MeshBytes> (*files_of)(const TriMesh&);
  friend void PrintTo(const Writer& writer, std::ostream* out) { *out << writer.name; }
};

class MutatedMeshFiles : public testing::TestWithParam<Writer> {};

TEST_P(MutatedMeshFiles, GiveAMeshOrOneLineAndNeverMuchMemory) {
  constexpr int mutations = 20000;
  const auto files = GetParam().files_of(test::box({0, 0, 0}, {30, 20.5, 10.25}));
  Random random(20240229);
  for (int i = 0; i < mutations; ++i) {
    const auto& file = files[below(random, files.size())];
    const std::string bytes = mutated(file.bytes, files[below(random, files.size())].bytes, random);
    test::largest_allocation = 0;
    const std::string broken = test::broken_promise(bytes, file.format);
    ASSERT_EQ(broken, "") << "mutation " << i << " of " << file.name;
    ASSERT_LE(test::largest_allocation, test::allowed_at_once(bytes.size()))
        << "mutation " << i << " of " << file.name;
  }
}

INSTANTIATE_TEST_SUITE_P(EveryFormat, MutatedMeshFiles,
                         testing::Values(Writer{"stl", test::stl_files}, Writer{"obj", test::obj_files},
                                         Writer{"ply", test::ply_files}, Writer{"vtp", test::vtp_files},
                                         Writer{"legacy_vtk", test::legacy_vtk_files}),
                         [](const auto& writer) { return writer.param.name; });

}  // namespace
}  // namespace condyle
