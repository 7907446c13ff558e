#pragma once

#include <optional>
#include <stop_token>

#include "condyle/implant.hpp"
#include "condyle/sample/hip.hpp"

namespace condyle {

/// The sample hip with a total hip in it, as parts of two bodies in the joint frame at zero angles:
///
///     fixed   hip_bone, liner               the cup lies in the socket, with its centre
///     mobile  femur, head, neck, stem       the femur is cut across its neck where neck and stem of the implant meet
///
/// The axis of the femur's shaft is moved onto that of the stem, so that offset and version of the stem move the bone, and the bone down by
/// the leg's lengthening: none of them changes the limits of neck and liner. The cup is as large as it is whatever the socket is; it must
/// fit into it. Bones that the implant brings into contact are in contact, as a joint file says when it is read.
///
/// Throws UsageError as check_implant() and sample_hip() do, for a cup larger than the socket, and for a neck of the femur that cannot be cut
/// there. Empty if it was stopped. Same parameters, same bytes.
std::optional<ImplantMeshes> sample_replacement(const TotalHip& implant, const HipParameters& bones,
                                                const Resolution& resolution, Side side,
                                                const std::stop_token& stop = {});

}  // namespace condyle
