#include "io/file/file_calls.hpp"

#include <fcntl.h>
#include <io.h>

#include <algorithm>
#include <cerrno>

#include "system_error.hpp"

/// As src/io/file/file_calls.cpp, by Windows' own calls: names are UTF-16 there, and its C library knows no identity of a file.

namespace condyle::io {
namespace {

namespace fs = std::filesystem;

/// Others may read, replace and remove what is open here, as on POSIX.
constexpr DWORD shared = FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE;

/// What is open, as Windows numbers it; closed at the end unless it was handed on.
class Handle {
 public:
  explicit Handle(HANDLE handle) noexcept : handle_(handle) {}
  ~Handle() {
    if (is_open()) ::CloseHandle(handle_);
  }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;

  bool is_open() const noexcept { return handle_ != INVALID_HANDLE_VALUE; }
  HANDLE get() const noexcept { return handle_; }

  /// The C library's number of it; below 0 with errno set.
  int as_stream(int flags) noexcept {
    const int stream = ::_open_osfhandle(reinterpret_cast<intptr_t>(handle_), flags);
    if (stream >= 0) handle_ = INVALID_HANDLE_VALUE;
    return stream;
  }

 private:
  HANDLE handle_;
};

HANDLE opened(const fs::path& path, DWORD access, DWORD how, DWORD flags = FILE_ATTRIBUTE_NORMAL) noexcept {
  return ::CreateFileW(path.c_str(), access, shared, nullptr, how, flags, nullptr);
}

int last_error() noexcept {
  return error_of(::GetLastError());
}

int look_at_handle(HANDLE handle, FileStatus& status) noexcept {
  using Kind = FileStatus::Kind;
  const DWORD type = ::GetFileType(handle);
  if (type == FILE_TYPE_CHAR || type == FILE_TYPE_PIPE) {
    status = {Kind::characters, 0, {}};
    return 0;
  }
  BY_HANDLE_FILE_INFORMATION seen{};
  if (!::GetFileInformationByHandle(handle, &seen)) return last_error();
  const auto whole = [](DWORD high, DWORD low) { return static_cast<std::uint64_t>(high) << 32 | low; };
  status = {(seen.dwFileAttributes & FILE_ATTRIBUTE_DIRECTORY) != 0 ? Kind::folder : Kind::file,
            whole(seen.nFileSizeHigh, seen.nFileSizeLow),
            {seen.dwVolumeSerialNumber, whole(seen.nFileIndexHigh, seen.nFileIndexLow)}};
  return 0;
}

/// A stream that writes what is open; null with errno set.
std::FILE* to_write(HANDLE file) noexcept {
  Handle handle(file);
  if (!handle.is_open()) {
    errno = last_error();
    return nullptr;
  }
  const int stream = handle.as_stream(_O_WRONLY | _O_BINARY | _O_NOINHERIT);
  if (stream < 0) return nullptr;
  std::FILE* const opened_file = ::_fdopen(stream, "wb");
  if (opened_file == nullptr) {
    ::_close(stream);
    errno = ENOMEM;
  }
  return opened_file;
}

/// In UTF-8; halves of characters, which Windows has in names, become U+FFFD.
std::string text_of(const wchar_t* name) {
  const int bytes = ::WideCharToMultiByte(CP_UTF8, 0, name, -1, nullptr, 0, nullptr, nullptr);
  std::string text(static_cast<std::size_t>(std::max(bytes, 1)), '\0');
  ::WideCharToMultiByte(CP_UTF8, 0, name, -1, text.data(), bytes, nullptr, nullptr);
  text.pop_back();  // the 0 at its end
  return text;
}

}  // namespace

int look_at(const fs::path& path, FileStatus& status) noexcept {
  // Only with this flag folders can be opened.
  const Handle handle(opened(path, FILE_READ_ATTRIBUTES, OPEN_EXISTING, FILE_FLAG_BACKUP_SEMANTICS));
  return handle.is_open() ? look_at_handle(handle.get(), status) : last_error();
}

int look_at_open(int stream, FileStatus& status) noexcept {
  return look_at_handle(reinterpret_cast<HANDLE>(::_get_osfhandle(stream)), status);
}

bool passes(int error) noexcept {
  switch (error) {
    case EIO:
    case EINTR:
    case EAGAIN:
    case EMFILE:
    case ENFILE:
    case ENOMEM:
    case ENOSPC:
    case EBUSY:
    case ENOLCK:
    case ETIMEDOUT:
      return true;
    default:
      return false;
  }
}

int open_to_read(const fs::path& path, int& stream) noexcept {
  Handle handle(opened(path, GENERIC_READ, OPEN_EXISTING));
  if (!handle.is_open()) return last_error();
  stream = handle.as_stream(_O_RDONLY | _O_BINARY | _O_NOINHERIT);
  return stream < 0 ? errno : 0;
}

int read_at(int stream, std::uint64_t at, std::span<char> out, std::size_t& got) noexcept {
  constexpr std::size_t most_at_once = std::size_t{1} << 30;  // bytes: what fits a DWORD
  OVERLAPPED place{};
  place.Offset = static_cast<DWORD>(at & 0xFFFFFFFFu);
  place.OffsetHigh = static_cast<DWORD>(at >> 32);
  DWORD read = 0;
  const bool done = ::ReadFile(reinterpret_cast<HANDLE>(::_get_osfhandle(stream)), out.data(),
                               static_cast<DWORD>(std::min(out.size(), most_at_once)), &read, &place);
  got = read;
  return done || ::GetLastError() == ERROR_HANDLE_EOF ? 0 : last_error();
}

void close_stream(int stream) noexcept {
  ::_close(stream);
}

bool is_readable(const fs::path& path) noexcept {
  return Handle(opened(path, GENERIC_READ, OPEN_EXISTING)).is_open();
}

int why_not_writable(const fs::path& path) noexcept {
  return Handle(opened(path, GENERIC_WRITE, OPEN_EXISTING)).is_open() ? 0 : last_error();
}

int names_in(const fs::path& folder, std::vector<std::string>& names) {
  WIN32_FIND_DATAW entry{};
  const HANDLE search = ::FindFirstFileW((folder / L"*").c_str(), &entry);
  if (search == INVALID_HANDLE_VALUE) return last_error();
  const struct Close {
    HANDLE search;
    ~Close() { ::FindClose(search); }
  } close{search};
  do names.push_back(text_of(entry.cFileName));
  while (::FindNextFileW(search, &entry));
  return ::GetLastError() == ERROR_NO_MORE_FILES ? 0 : last_error();
}

std::optional<std::string> variable_of_process(const std::string& name) {
  const std::wstring wide = fs::path(name).native();
  std::wstring value(1, L'\0');
  for (;;) {
    ::SetLastError(ERROR_SUCCESS);
    const DWORD length =
        ::GetEnvironmentVariableW(wide.c_str(), value.data(), static_cast<DWORD>(value.size()));
    if (length == 0 && ::GetLastError() != ERROR_SUCCESS) return std::nullopt;
    if (length < value.size()) return text_of(value.c_str());
    value.resize(length + 1);
  }
}

std::FILE* new_file(const fs::path& path) noexcept {
  return to_write(opened(path, GENERIC_WRITE, CREATE_NEW));
}

std::FILE* opened_to_write_into(const fs::path& path) noexcept {
  return to_write(opened(path, GENERIC_WRITE, OPEN_EXISTING));
}

int move_file(const fs::path& from, const fs::path& to) noexcept {
  return ::MoveFileExW(from.c_str(), to.c_str(), MOVEFILE_REPLACE_EXISTING) ? 0 : last_error();
}

int remove_file(const fs::path& path) noexcept {
  return ::DeleteFileW(path.c_str()) ? 0 : last_error();
}

int number_of_process() noexcept {
  return static_cast<int>(::GetCurrentProcessId());
}

}  // namespace condyle::io
