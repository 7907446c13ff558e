#pragma once

#include <cstddef>

#include "condyle/io/picture.hpp"
#include "io/picture/colour_scale.hpp"

/// The scale of the colours under a picture, and what it shares with the picture.

namespace condyle::io {

void set_pixel(Picture& picture, std::size_t column, std::size_t row, const Rgb& colour) noexcept;

/// Grey stripes at a place in pixels.
Rgb hatching(double x, double y) noexcept;

/// White stripes over the colour of an end of the scale, for what is beyond it.
Rgb striped(const Rgb& colour, double x, double y) noexcept;

/// Rows of pixels at the bottom that are the legend's; 0 if nothing is coloured.
std::size_t legend_height(const PictureOptions& options) noexcept;

/// The name of the quantity, its bar, its ends and zero in mm, how what is beyond the ends looks; for depths a
/// swatch of hatching too.
void draw_legend(Picture& picture, const PictureOptions& options, const ColourScale& scale);

}  // namespace condyle::io
