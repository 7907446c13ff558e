#pragma once

#include <functional>

#include "condyle/sample/cartilages.hpp"
#include "condyle/sample/hip.hpp"
#include "sample/field.hpp"

namespace condyle::sample {

/// Where the cartilages of a hip meet bone and each other: spheres about the hip centre, radii in mm.
///
///     bone | femoral cartilage |  clearance  | acetabular cartilage | bone
///        head               femoral      acetabular               socket
struct ArticularSpheres {
  double head, femoral, acetabular, socket;
  double femoral_thickness() const noexcept { return femoral - head; }
  double acetabular_thickness() const noexcept { return socket - acetabular; }
};
ArticularSpheres articular_spheres(const HipParameters&, const CartilageParameters&) noexcept;

/// A sheet of cartilage, and how far a point near it is from where the sheet ends: mm, about, >= 0.
struct Cartilage {
  Solid solid;
  std::function<double(const Vec3&)> border_distance;
};

/// Cap over the femoral head up to a margin around the neck's axis, short of where head and neck blend. Its
/// outer side is the exact `femoral` sphere but for the rounded margin, its inner side the surface of the
/// bone. A cam changes nothing: it is bone that stands out through the cartilage. Genus 0.
Cartilage femoral_cartilage_shape(const HipParameters&, const CartilageParameters&);

/// Lining of the socket with the labrum on its rim: a ring around the acetabular fossa, which stays free of
/// cartilage, and closed below by the labrum, which crosses the notch as the transverse ligament does.
///
///          labrum                 labrum      the rim's plane
///          (  ).___           ___.(  )
///        ---'      ` - ._. - '      '---     inner side: the `acetabular` sphere
///           `.     cartilage     .'          outer side: the surface of the bone
///              ` - .       . - '
///                   | fossa |
///
/// Its inner side is that exact sphere from the fossa's edge to the labrum's tip, rounded edges aside.
/// Genus 1.
Cartilage acetabular_cartilage_shape(const HipParameters&, const CartilageParameters&);

}  // namespace condyle::sample
