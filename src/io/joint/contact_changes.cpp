#include "condyle/io/joint_file.hpp"

#include <cstddef>

namespace condyle::io {
namespace {

/// The one value for both bodies, or that of this one.
void take(const std::vector<double>& given, std::size_t body, double& value) {
  if (!given.empty()) value = given.size() == 1 ? given[0] : given[body];
}

void change_layer(std::optional<LayerEntry>& layer, const ContactChanges& changes, std::size_t body) {
  if (!changes.any_of_layers()) return;
  const bool whole =
      !changes.youngs_modulus_mpa.empty() && !changes.poisson_ratio.empty() && !changes.thickness_mm.empty();
  if (!layer && !whole) return;
  if (!layer) layer.emplace();
  take(changes.youngs_modulus_mpa, body, layer->youngs_modulus_mpa);
  take(changes.poisson_ratio, body, layer->poisson_ratio);
  if (!changes.thickness_mm.empty())
    layer->behind.reset(), layer->thickness_file.reset(), layer->thickness_bounds_mm.reset();
  take(changes.thickness_mm, body, layer->thickness_mm);
}

}  // namespace

ContactEntry changed(ContactEntry entry, const ContactChanges& changes) {
  if (changes.casting) entry.casting = *changes.casting;
  if (changes.rule) entry.rays.rule = *changes.rule;
  if (changes.reach_mm) entry.rays.reach_mm = *changes.reach_mm;
  if (changes.law) entry.law = *changes.law;
  change_layer(entry.fixed, changes, 0);
  change_layer(entry.mobile, changes, 1);
  return entry;
}

}  // namespace condyle::io
