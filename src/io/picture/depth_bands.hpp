#pragma once

#include "condyle/io/picture.hpp"
#include "condyle/resection.hpp"

namespace condyle::io {

/// Width of the bands that a cut is drawn in: the first of 0.25, 0.5, 1 and 2 mm with which seven hold its depth, else more of 2 mm.
double depth_band_mm(const plan::CutBone& cut);

/// The surface before, where something goes, in bands of equal depth from yellow to dark red: between two colours runs a contour line.
/// Each with its depths for the key; in the frame of the bone.
std::vector<PictureMark> depth_bands(const plan::CutBone& cut);

/// From where the cut is seen best: along its mean normal.
ViewDirection view_of(const plan::CutBone& cut);

/// Height of a picture about the joint centre that holds the cut, mm: that of a hip's head and neck, or more. Widths are 4 to 3.
double field_of(const plan::CutBone& cut, const ViewDirection& view);

}  // namespace condyle::io
