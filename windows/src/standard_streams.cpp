#include "standard_streams.hpp"

#include <fcntl.h>
#include <io.h>
#include <windows.h>
//
#include <shellapi.h>

#include <algorithm>
#include <cstdlib>
#include <memory>

/// As cli/standard_streams.cpp. Words of the command line are UTF-16 on Windows, a console has a character set, and a stream of text would
/// end its lines by two characters.

namespace condyle::cli {
namespace {

UINT set_before = 0;

/// The console keeps its character set after the command.
void speak_utf8() {
  set_before = ::GetConsoleOutputCP();
  if (set_before == 0 || set_before == CP_UTF8 || !::SetConsoleOutputCP(CP_UTF8)) return;
  std::atexit([] { ::SetConsoleOutputCP(set_before); });
}

/// Progress wipes its line by a sequence of ECMA-48, which a console of Windows obeys when it is asked to.
void obey_sequences() {
  const HANDLE error = ::GetStdHandle(STD_ERROR_HANDLE);
  DWORD mode = 0;
  if (::GetConsoleMode(error, &mode)) ::SetConsoleMode(error, mode | ENABLE_VIRTUAL_TERMINAL_PROCESSING);
}

std::string in_utf8(const wchar_t* word) {
  const int bytes = ::WideCharToMultiByte(CP_UTF8, 0, word, -1, nullptr, 0, nullptr, nullptr);
  std::string text(static_cast<std::size_t>(std::max(bytes, 1)), '\0');
  ::WideCharToMultiByte(CP_UTF8, 0, word, -1, text.data(), bytes, nullptr, nullptr);
  text.pop_back();  // the 0 at its end
  return text;
}

}  // namespace

void hold_standard_streams() {
  for (const int stream : {0, 1, 2}) {
    // -2: Windows started the process without it.
    if (const auto handle = ::_get_osfhandle(stream); handle == -1 || handle == -2) {
      // Opened for reading, the number is taken and writing still fails.
      const int nothing = ::_open("NUL", _O_RDONLY);
      if (nothing >= 0 && nothing != stream) {
        ::_dup2(nothing, stream);
        ::_close(nothing);
      }
    }
    ::_setmode(stream, _O_BINARY);
  }
  speak_utf8();
  obey_sequences();
}

std::vector<std::string> words_of_command_line(int, char**) {
  int count = 0;
  const std::unique_ptr<wchar_t*, decltype(&::LocalFree)> words(
      ::CommandLineToArgvW(::GetCommandLineW(), &count), ::LocalFree);
  std::vector<std::string> texts;
  for (int i = 1; words && i < count; ++i) texts.push_back(in_utf8(words.get()[i]));
  return texts;
}

bool standard_error_is_terminal() noexcept {
  DWORD mode = 0;
  return ::GetConsoleMode(::GetStdHandle(STD_ERROR_HANDLE), &mode) != 0;
}

void write_to_standard_error(std::string_view line) noexcept {
  DWORD written = 0;
  ::WriteFile(::GetStdHandle(STD_ERROR_HANDLE), line.data(), static_cast<DWORD>(line.size()), &written,
              nullptr);
}

}  // namespace condyle::cli
