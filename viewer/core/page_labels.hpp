#pragma once

#include <cstdint>

/// Joints of label maps that were dropped on the page: read, cut out and placed as by `condyle init LABELS`.

extern "C" {

struct CondyleJoint;
struct CondyleLabels;
struct CondyleBone;

/// The label map of a file's bytes; the ending of its name gives the format. Null for a bad file, with the command line's own line in
/// condyle_error().
CondyleLabels* condyle_read_labels(const char* name, const std::uint8_t* bytes, int count);
void condyle_free_labels(CondyleLabels* labels);

/// As JSON `labels`, of each but 0 `choice` ("76", or "1:76" where there are layers), `name` in the file or "", and `voxels`; and
/// `pairs`, the bones of a hip that the file's own names or a table of TotalSegmentator finds: `side`, `task` (null: the
/// file's names), and `fixed` and `mobile`, each `label` to ask for and `choice`. Null where there are no labels, or more than
/// bones.
const char* condyle_labels(CondyleLabels* labels);

/// The surface of one label: `label` as `condyle init --fixed` takes it, or "" for the only one; `task` of its names, or "". Borrows
/// the label map. Null with the command line's own line.
CondyleBone* condyle_bone(const CondyleLabels* labels, const char* label, const char* task);
void condyle_free_bone(CondyleBone* bone);
/// As the joint calls it: "hip_right".
const char* condyle_bone_name(const CondyleBone* bone);

/// The joint that `condyle init` proposes for two bones: axes of the image, centre fitted to the head. `side`: 0 right, 1 left, -1
/// by the names of the labels, else inferred from the bones. Null if something cannot be inferred.
CondyleJoint* condyle_join(const CondyleBone* fixed, const CondyleBone* mobile, int side);
}
