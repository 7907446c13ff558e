#pragma once

#include "motion/search/feature_tree.hpp"

namespace condyle::motion {

/// A pair of nodes still to be tested, and the smallest rotation after which they can meet.
struct NodePair {
  Index rotating, stationary;
  double gap;
};

/// Splits the larger of two nodes, of which not both are leaves, and calls visit with each pair that results.
template <class Visit>
void split(const FeatureTree& rotating, const FeatureTree& stationary, const NodePair& pair,
           const Visit& visit) {
  const auto &m = rotating.nodes()[pair.rotating], &f = stationary.nodes()[pair.stationary];
  if (f.is_leaf() || (!m.is_leaf() && m.size() > f.size())) {
    visit(m.child, pair.stationary);
    visit(m.child + 1, pair.stationary);
  } else {
    visit(pair.rotating, f.child);
    visit(pair.rotating, f.child + 1);
  }
}

}  // namespace condyle::motion
