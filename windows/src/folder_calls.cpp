#include "io/file/folder_calls.hpp"

#include <atomic>
#include <cstdint>
#include <string_view>

#include "system_error.hpp"

/// As src/io/file/folder_calls.cpp. Windows has no signals: Ctrl-C comes in a thread of its own, which may wait and take memory.

namespace condyle::io {
namespace {

int last_error() noexcept {
  return error_of(::GetLastError());
}

}  // namespace

int make_folder(const std::filesystem::path& folder) noexcept {
  return ::CreateDirectoryW(folder.c_str(), nullptr) || ::GetLastError() == ERROR_ALREADY_EXISTS
             ? 0
             : last_error();
}

int make_folder_of_own(SystemName& name) noexcept {
  constexpr std::wstring_view letters = L"0123456789abcdefghijklmnopqrstuvwxyz";
  constexpr std::size_t free_letters = 6;
  static std::atomic<std::uint64_t> calls = 0;
  // Another process may have taken a name: the next one is tried.
  for (int attempt = 0; attempt < 10'000; ++attempt) {
    // Process, time and call, spread over all bits by an odd factor (Knuth's multiplicative hashing).
    std::uint64_t number = ::GetCurrentProcessId() ^ ::GetTickCount64() << 20 ^ ++calls << 44;
    number = number * 0x9E3779B97F4A7C15u >> 16;
    for (std::size_t i = name.size() - free_letters; i < name.size(); ++i, number /= letters.size())
      name[i] = letters[number % letters.size()];
    if (::CreateDirectoryW(name.c_str(), nullptr)) return 0;
    if (::GetLastError() != ERROR_ALREADY_EXISTS) return last_error();
  }
  return error_of(ERROR_ALREADY_EXISTS);
}

void remove_empty_folder(const SystemName& folder) noexcept {
  ::RemoveDirectoryW(folder.c_str());
}

void remove_with_files(const SystemName& folder) noexcept try {
  // Another thread may write one more file between the last look and the folder's end.
  for (int attempt = 0; attempt < 100; ++attempt) {
    if (::RemoveDirectoryW(folder.c_str()) || ::GetLastError() != ERROR_DIR_NOT_EMPTY) return;
    WIN32_FIND_DATAW entry{};
    const HANDLE search = ::FindFirstFileW((folder + L"\\*").c_str(), &entry);
    if (search == INVALID_HANDLE_VALUE) return;
    do ::DeleteFileW((folder + L'\\' + entry.cFileName).c_str());  // fails for . and ..
    while (::FindNextFileW(search, &entry));
    ::FindClose(search);
  }
} catch (...) {
  // Without memory for a name its file stays.
}

void wait_a_millisecond() noexcept {
  ::Sleep(1);
}

void hold_off_signals() noexcept {}

void let_signals_in() noexcept {}

}  // namespace condyle::io
