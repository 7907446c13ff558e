#include <codecvt>
#include <cwchar>
#include <filesystem>
#include <locale>
#include <string>

/// Two functions of libstdc++'s std::filesystem::path, which the linker puts in the place of its own (--wrap).

namespace {

using Result = std::codecvt_base::result;
using std::filesystem::path;

/// Texts of the library are UTF-8, and a path has UTF-16 on Windows. libstdc++ 12 makes the one of the other by the C library's locale,
/// which has no UTF-8 in msvcrt.dll, and back by UTF-8. Here both are UTF-8. Bytes that are none become U+FFFD: a name of which
/// nothing is there, as messages then say.
extern "C" Result __wrap__ZNKSt7codecvtIwciE5do_inERiPKcS3_RS3_PwS5_RS5_(const void*, std::mbstate_t& state,
                                                                         const char* from,
                                                                         const char* from_end,
                                                                         const char*& from_next, wchar_t* to,
                                                                         wchar_t* to_end, wchar_t*& to_next) {
  constexpr wchar_t replacement = 0xFFFD;
  static const std::codecvt_utf8_utf16<wchar_t> utf8;
  // Never more letters of UTF-16 than bytes: where there is room for as many, what stops it is the input.
  while (utf8.in(state, from, from_end, from_next, to, to_end, to_next) != Result::ok) {
    if (from_next == from_end) break;
    if (to_next == to_end) return Result::partial;
    *to_next++ = replacement;
    from = ++from_next;
    to = to_next;
    state = {};
  }
  return Result::ok;
}

extern "C" path& __real__ZNSt10filesystem7__cxx114pathdVERKS1_(path* folder, const path& name);

/// folder /= name with the sign between them that all systems take: what is written of paths is then the same on each.
extern "C" path& __wrap__ZNSt10filesystem7__cxx114pathdVERKS1_(path* folder, const path& name) {
  const std::size_t end = folder->native().size();
  __real__ZNSt10filesystem7__cxx114pathdVERKS1_(folder, name);
  std::wstring joined = folder->native();
  if (end > 0 && joined.size() > end && joined[end] == path::preferred_separator) {
    joined[end] = L'/';
    *folder = path(std::move(joined));
  }
  return *folder;
}

}  // namespace
