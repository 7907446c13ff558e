#include "fuzz/mesh_reader_promise.hpp"
#include "fuzz/targets.hpp"

namespace condyle::test {

std::string fuzz_mesh_reader(std::string_view bytes) {
  constexpr int formats = static_cast<int>(io::MeshFormat::vtk) + 1;
  if (bytes.empty()) return {};
  return broken_promise(bytes.substr(1),
                        static_cast<io::MeshFormat>(static_cast<unsigned char>(bytes[0]) % formats));
}

}  // namespace condyle::test
