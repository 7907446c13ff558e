#include "io/picture/colour_scale.hpp"

#include <algorithm>
#include <cstddef>

namespace condyle::io {
namespace {

using Stops = std::array<Rgb, 17>;

// d3-scale-chromatic's OrRd from 0.4 to 1 and YlGnBu from 1 to 0.1 (ColorBrewer, C. Brewer), and inferno from 0.85 to 0
// (N. Smith, S. van der Walt), at equal distances: between these stops they are straight to 5 of 255.
constexpr Stops inside = {{{253, 176, 122},
                           {252, 164, 111},
                           {251, 151, 100},
                           {249, 138, 90},
                           {246, 125, 83},
                           {242, 112, 76},
                           {237, 99, 68},
                           {231, 84, 58},
                           {224, 69, 48},
                           {216, 54, 36},
                           {207, 39, 26},
                           {196, 25, 16},
                           {185, 14, 9},
                           {172, 6, 4},
                           {158, 2, 1},
                           {143, 0, 0},
                           {127, 0, 0}}};
constexpr Stops apart = {{{8, 29, 88},
                          {21, 40, 114},
                          {30, 52, 137},
                          {34, 68, 153},
                          {34, 86, 164},
                          {33, 107, 174},
                          {33, 129, 184},
                          {39, 149, 191},
                          {52, 167, 194},
                          {72, 181, 194},
                          {97, 193, 191},
                          {125, 205, 188},
                          {156, 216, 184},
                          {185, 227, 181},
                          {208, 237, 180},
                          {226, 244, 181},
                          {239, 249, 189}}};
constexpr Stops deep = {{{251, 190, 35},
                         {252, 165, 10},
                         {249, 139, 11},
                         {241, 115, 29},
                         {231, 94, 46},
                         {216, 76, 62},
                         {199, 62, 76},
                         {179, 50, 90},
                         {157, 41, 100},
                         {136, 34, 106},
                         {114, 26, 110},
                         {93, 18, 110},
                         {71, 11, 106},
                         {47, 10, 91},
                         {25, 12, 62},
                         {8, 5, 29},
                         {0, 0, 4}}};

Rgb between(const Stops& stops, double share) noexcept {
  const double along = std::clamp(share, 0.0, 1.0) * static_cast<double>(stops.size() - 1);
  const std::size_t low = std::min(static_cast<std::size_t>(along), stops.size() - 2);
  const double part = along - static_cast<double>(low);
  Rgb colour;
  for (std::size_t k = 0; k < 3; ++k) colour[k] = (1 - part) * stops[low][k] + part * stops[low + 1][k];
  return colour;
}

}  // namespace

std::optional<Rgb> ColourScale::at(double mm) const noexcept {
  const double share = mm / range_mm;
  if (colour == PictureColour::depth) return between(deep, share);
  if (share > 1) return std::nullopt;
  return share < 0 ? between(inside, -share) : between(apart, share);
}

}  // namespace condyle::io
