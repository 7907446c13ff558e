#pragma once

#include "core/parallel.hpp"
#include "io/file/input_recorder.hpp"

namespace condyle::io {

/// Reads two things at the same time. What they read is recorded as if the second had been read after the first, and not at all if the
/// first failed: a key knows the order.
template <class First, class Second>
void read_pair(const First& first, const Second& second) {
  if (InputRecorder::current() == nullptr) return core::parallel_pair(first, second);
  const auto digests =
      InputRecorder::takes_digests() ? InputRecorder::Digests::taken : InputRecorder::Digests::left_out;
  struct Reading {
    Recorded recorded;
    bool is_done = false;
  } of_first, of_second;
  const auto read = [&](const auto& body, Reading& reading) {
    const Recording apart(nullptr);
    const InputRecorder own(digests);
    const auto keep = [&](bool is_done) { reading = {own.recorded(), is_done}; };
    try {
      body();
    } catch (...) {
      keep(false);
      throw;
    }
    keep(true);
  };
  const auto enter = [&] {
    InputRecorder::add(of_first.recorded);
    if (of_first.is_done) InputRecorder::add(of_second.recorded);
  };
  try {
    core::parallel_pair([&] { read(first, of_first); }, [&] { read(second, of_second); });
  } catch (...) {
    enter();
    throw;
  }
  enter();
}

}  // namespace condyle::io
