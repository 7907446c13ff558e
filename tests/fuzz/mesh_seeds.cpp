#include <exception>
#include <filesystem>
#include <fstream>
#include <iostream>

#include "support/mesh_bytes.hpp"
#include "support/test_meshes.hpp"

/// Writes a small mesh in every encoding into a folder, each file after the byte that chooses its reader:
/// seeds for fuzz_mesh_reader, which would hardly guess a whole header.
int main(int count, char** words) try {
  if (count != 2) {
    std::cerr << "usage: mesh_seeds FOLDER\n";
    return 2;
  }
  const std::filesystem::path folder = words[1];
  std::filesystem::create_directories(folder);
  for (const auto& seed : condyle::test::all_files(condyle::test::box({0, 0, 0}, {30, 20.5, 10.25}))) {
    std::ofstream file(folder / seed.name, std::ios::binary);
    file.put(static_cast<char>(seed.format))
        .write(seed.bytes.data(), static_cast<std::streamsize>(seed.bytes.size()));
  }
  return 0;
} catch (const std::exception& error) {
  std::cerr << error.what() << '\n';
  return 1;
}
