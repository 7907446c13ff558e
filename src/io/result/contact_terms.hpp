#pragma once

#include <string>

#include "condyle/io/joint_file.hpp"
#include "io/result/json.hpp"

/// Assumptions behind depths and pressures of surfaces in contact, worded the same in every answer.

namespace condyle::io {

std::string_view name_of(contact::Casting casting) noexcept;
std::string_view name_of(contact::FaceRule rule) noexcept;
std::string_view name_of(contact::PressureLaw law) noexcept;

/// casting, rule, reach, and with pressure law, layers and the body whose moment is reported.
Json contact_caveats(const ContactEntry& entry, bool with_pressure);
/// The same as one line.
std::string contact_caveats_text(const ContactEntry& entry, const ContactSurfaces& surfaces,
                                 bool with_pressure);

Json totals_json(const contact::ContactTotals& totals, bool with_pressure);

/// A line on overlap that has no depth along normals, as its rays meet the other surface at a slant; empty if there is none.
std::string oblique_text(const contact::SurfaceContact& surface, contact::FaceRule rule);
/// A line that compares a force with that of 16 places of each face.
std::string refined_force_text(const Vec3& force_n, const Vec3& refined_n);

/// The face in contact with the greatest depth; null without contact.
const contact::FaceContact* deepest_of(const contact::SurfaceContact& surface);
/// The part of the body that a triangle is of and its number there, under this key; nothing if the body is one mesh.
void add_triangle_part(Json& json, const char* key, const Body& body, Index triangle);
/// " (12 of meniscus)": the same behind the number of a triangle.
std::string triangle_part_text(const Body& body, Index triangle);

}  // namespace condyle::io
