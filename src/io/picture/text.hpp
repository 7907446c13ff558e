#pragma once

#include <string>

#include "condyle/io/picture.hpp"
#include "io/picture/colour_scale.hpp"

/// Letters and lines over a picture.

namespace condyle::io {

enum class Alignment { left, centre, right };

/// Rows of pixels of a picture.
struct Rows {
  std::size_t first, end;
};

/// Letters and bars at places in pixels, drawn all at once in black.
class Text {
 public:
  /// Letters `size` high on a base line.
  void add(const std::string& text, double x, double base_line, double size, Alignment alignment);
  /// A filled rectangle.
  void add_box(double left, double right, double top, double bottom);
  /// Over these rows; with a halo, so that it is read over bone, the parts of it drawn wider and white before.
  void draw(Picture& picture, Rows rows) const;

 private:
  TriMesh mesh_, halo_;
};

/// Width of a text whose letters are 1 high.
double width_of(const std::string& text);

}  // namespace condyle::io
