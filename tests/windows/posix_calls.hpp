#pragma once

// Functions of POSIX that tests call and mingw's C library has not: included before every file of a suite that is compiled for Windows.

#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <random>
#include <string>

/// Makes a folder of a name that no other has; its last six characters are X.
inline char* mkdtemp(char* pattern) {
  const std::string stem(pattern, std::string(pattern).size() - 6);
  std::random_device random;
  for (int attempt = 0; attempt < 100; ++attempt) {
    const std::string name = stem + std::to_string(100'000 + random() % 900'000);
    std::error_code failed;
    if (!std::filesystem::create_directory(name, failed)) continue;
    return static_cast<char*>(std::memcpy(pattern, name.c_str(), name.size()));
  }
  return nullptr;
}

inline int setenv(const char* name, const char* value, int) {
  return ::_putenv_s(name, value);
}

inline int unsetenv(const char* name) {
  return ::_putenv_s(name, "");
}
