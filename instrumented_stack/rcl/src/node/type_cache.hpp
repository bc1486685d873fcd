// SPDX-License-Identifier: Apache-2.0
// The types that a node uses, by their hashes.
#pragma once

#include <cstddef>
#include <map>
#include <mutex>
#include <string>

#include "rcl/node.h"
#include "rosidl_runtime_c/type_description.h"

namespace rcl {

class TypeCache {
 public:
  void add(const rosidl_type_description_t& description);
  // Returns false if the type is not in use.
  bool remove(const rosidl_type_description_t& description);
  // Null if the type is not in use.
  const rosidl_type_description_t* find(const std::string& type_hash) const;

 private:
  struct Use {
    const rosidl_type_description_t* description = nullptr;
    std::size_t count = 0;
  };
  mutable std::mutex mutex_;
  std::map<std::string, Use> types_;
};

// Null, with the error set, if the node is not initialized.
TypeCache* type_cache_of(const rcl_node_t* node);

}  // namespace rcl
