#pragma once

#include <cstddef>

#include "condyle/io/picture.hpp"
#include "io/picture/colour_scale.hpp"

/// The scale of the colours and the key of the marks under a picture, and what they share with the picture.

namespace condyle::io {

void set_pixel(Picture& picture, std::size_t column, std::size_t row, const Rgb& colour) noexcept;

/// Grey stripes at a place in pixels.
Rgb hatching(double x, double y) noexcept;

/// White stripes over the colour of an end of the scale, for what is beyond it.
Rgb striped(const Rgb& colour, double x, double y) noexcept;

/// Rows of pixels at the bottom that are the legend's, the scale over the key of the marks; 0 if nothing is coloured and no mark has a
/// meaning.
std::size_t legend_height(const PictureOptions& options) noexcept;

/// The name of the quantity, its bar, its ends and zero in mm, how what is beyond the ends looks; for depths a
/// swatch of hatching too. The key: a swatch of each colour and its meaning.
void draw_legend(Picture& picture, const PictureOptions& options, const ColourScale& scale);

}  // namespace condyle::io
