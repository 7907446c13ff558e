#pragma once

#include <stdexcept>

namespace condyle {

/// A file that cannot be read or written, or does not say what its format asks for. The message is one line:
/// file, element, what is wrong.
class FileError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A mesh that was read well but does not allow the query: open although a closed surface is needed, of inverted
/// orientation, the joint centre on its surface. The message is one line.
class MeshError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A value outside its domain that came from a user: a pose, a range, an unknown name. One line.
class UsageError : public std::invalid_argument {
 public:
  using std::invalid_argument::invalid_argument;
};

}  // namespace condyle
