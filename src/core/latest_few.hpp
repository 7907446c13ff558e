#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <memory>
#include <mutex>

#include "core/lazy.hpp"

namespace condyle::core {

/// Values by a key, each made when it is first asked for, once for all threads; the latest few are kept.
template <class Key, class Value, std::size_t most>
class LatestFew {
 public:
  /// make(Value&) where this key has none; keys compare by ==. Where it throws, the key has none still. One key's value is
  /// made while others are asked for.
  template <class Make>
  std::shared_ptr<const Value> get(const Key& key, const Make& make) const {
    const std::shared_ptr<Entry> entry = entry_of(key);
    return {entry, &entry->value.get(make)};
  }

 private:
  struct Entry {
    Key key;
    Lazy<Value> value;
    explicit Entry(const Key& of) : key(of) {}
  };

  std::shared_ptr<Entry> entry_of(const Key& key) const {
    const std::lock_guard lock(mutex_);
    const auto known = std::find_if(entries_.begin(), entries_.end(),
                                    [&](const auto& entry) { return entry && entry->key == key; });
    if (known != entries_.end()) {
      std::rotate(entries_.begin(), known, known + 1);
    } else {
      std::rotate(entries_.begin(), entries_.end() - 1, entries_.end());
      entries_.front() = std::make_shared<Entry>(key);
    }
    return entries_.front();
  }

  mutable std::mutex mutex_;
  mutable std::array<std::shared_ptr<Entry>, most> entries_;  ///< the latest first
};

}  // namespace condyle::core
