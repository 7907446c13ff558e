#pragma once

#include <optional>

#include "rotations/rotation_query.hpp"

/// Ways to answer whether the two features of a query meet.

namespace bench {

/// By the library's contact events, which it searches for first contact.
///
/// The library asks about features of meshes, and leaves some contact to neighbours that these have: a vertex that stays in a face's plane
/// to the face's edges, edges that are parallel when they meet to their ends and faces, and what is in contact before the motion to a test
/// of its own. A query has no neighbours, so the same kernels are asked about them here.
/// The angle from the start at which they first meet, in [0, 2 pi].
std::optional<double> first_contact_by_events(const RotationQuery& query);

/// By the search itself, for meshes of one triangle each, flat to the edge or the vertex. It leaves to neighbours what the kernels do, and a
/// flat triangle is in contact with nothing before the motion: not for degenerate queries.
bool meet_by_search(const RotationQuery& query);

/// By chords: points run straight over steps of the angle, and the features meet if they come as near to each other as an arc strays from
/// its chord. Conservative advancement along each chord (Mirtich 1996): it misses nothing, and the less it invents the smaller the steps.
bool meet_by_chords(const RotationQuery& query, double step);

/// By sampling: where the volume of the features' four points changes its sign from one angle to the next, its zero is found by bisection,
/// and there they meet or not. Two zeros within a step are missed, and one that changes no sign.
bool meet_by_samples(const RotationQuery& query, double step);

}  // namespace bench
