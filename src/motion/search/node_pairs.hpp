#pragma once

#include "motion/search/feature_tree.hpp"

namespace condyle::motion {

/// A pair of nodes still to be looked at, and the smallest rotation after which they can meet.
struct NodePair {
  Index turning, resting;
  double gap;
};

/// Splits the larger of two nodes, of which not both are leaves, and calls visit with each pair that results.
template <class Visit>
void split(const FeatureTree& turning, const FeatureTree& resting, const NodePair& pair, const Visit& visit) {
  const auto &m = turning.nodes()[pair.turning], &f = resting.nodes()[pair.resting];
  if (f.is_leaf() || (!m.is_leaf() && m.size() > f.size())) {
    visit(m.child, pair.resting);
    visit(m.child + 1, pair.resting);
  } else {
    visit(pair.turning, f.child);
    visit(pair.turning, f.child + 1);
  }
}

}  // namespace condyle::motion
