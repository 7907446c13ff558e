#include "interrupt.hpp"

#include <windows.h>

#include <atomic>
#include <cstdlib>

#include "io/file/temporary_folder.hpp"
#include "standard_streams.hpp"

/// As cli/interrupt.cpp: Ctrl-C, Ctrl-Break, a window that is closed and the end of a session come in a thread that Windows starts for
/// each, in place of signals.

namespace condyle::cli {
namespace {

std::atomic<bool> signalled = false, is_watched = false;

constexpr int exit_code = 130;

[[noreturn]] void end() noexcept {
  write_to_standard_error("condyle: interrupted; nothing more is written\n");
  io::end_temporary_folders();
  std::_Exit(exit_code);
}

BOOL WINAPI handle(DWORD event) noexcept {
  // The second one ends the process.
  if (!is_watched || signalled.exchange(true)) end();
  // Of any other Windows ends the process as soon as this returns: whoever watches does it before.
  if (event != CTRL_C_EVENT && event != CTRL_BREAK_EVENT) ::Sleep(INFINITE);
  return TRUE;
}

}  // namespace

void say_when_interrupted() noexcept {
  ::SetConsoleCtrlHandler(handle, TRUE);
}

InterruptWatch::InterruptWatch() {
  signalled = false;
  is_watched = true;
}

InterruptWatch::~InterruptWatch() {
  is_watched = false;
}

bool InterruptWatch::interrupted() const noexcept {
  return signalled;
}

}  // namespace condyle::cli
