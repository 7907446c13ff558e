#pragma once

#include <memory>
#include <mutex>
#include <typeindex>
#include <typeinfo>
#include <utility>
#include <vector>

#include "condyle/mesh.hpp"

namespace condyle::mesh {

/// Things that were found on a mesh and are kept with it, as its table of edges is: its tree of triangles, where it crosses itself,
/// its head. Whichever layer finds something has a type of its own here, with parts made on demand (core::Lazy,
/// core::LatestFew).
class Findings {
 public:
  /// The one of this type, which lives as long as the mesh. From any thread.
  template <class T>
  const T& get() {
    const std::lock_guard lock(mutex_);
    for (const auto& [type, finding] : all_)
      if (type == typeid(T)) return *static_cast<const T*>(finding.get());
    const auto made = std::make_shared<T>();
    all_.emplace_back(typeid(T), made);
    return *made;
  }

 private:
  std::mutex mutex_;
  std::vector<std::pair<std::type_index, std::shared_ptr<void>>> all_;
};

/// The findings of a mesh: copies share them, and a mesh that was moved has none yet.
Findings& findings_of(const Mesh& mesh);

}  // namespace condyle::mesh
