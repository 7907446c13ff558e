#pragma once

#include <optional>

#include "io/joint/proposal.hpp"

namespace condyle::io {

/// The unit of both meshes, as stated or by their sizes; empty if these do not speak for one.
std::optional<Stated<LengthUnit>> units_by_size(const ProposedBody& fixed, const ProposedBody& mobile,
                                                const ProposalFacts& facts);

/// The unit of the meshes of a hip: as stated, else by the radius of its head if that is an adult's in one unit, else by their
/// sizes. If head and socket speak for two units, the mobile mesh, or the fixed one, gets a scale.
std::optional<Stated<LengthUnit>> units_of_hip(ProposedBody& fixed, ProposedBody& mobile,
                                               const ProposalFacts& facts);

/// The mesh in mm without surfaces that lie inside others.
TriMesh surface_in_mm(const ProposedBody& body, LengthUnit units);

}  // namespace condyle::io
