// SPDX-License-Identifier: Apache-2.0
#include "rcl/described_types.hpp"

#include <map>
#include <string_view>

#include "node/type_cache.hpp"
#include "rcl/error_handling.h"

namespace rcl {

namespace {

using Types = std::map<std::string_view, const rosidl_type_description_t*>;

void add_nested_types(const rosidl_type_description_t& type, Types& types) {
  for (size_t i = 0; i < type.field_count; ++i) {
    const rosidl_type_description_t* nested = type.fields[i].nested_type;
    if (nested != nullptr && types.emplace(nested->type_name, nested).second) {
      add_nested_types(*nested, types);
    }
  }
}

bool is_type_hash(std::string_view text) {
  constexpr std::string_view kPrefix = "RIHS01_";
  return text.size() == kPrefix.size() + 64 && text.substr(0, kPrefix.size()) == kPrefix &&
         text.find_first_not_of("0123456789abcdef", kPrefix.size()) == std::string_view::npos;
}

}  // namespace

DescribedTypes describe_type(const rcl_node_t* node, const std::string& type_hash) {
  // Nodes of ROS 2 give the same reasons.
  if (!is_type_hash(type_hash)) {
    return {{}, "Failed to parse type hash"};
  }
  const TypeCache* cache = type_cache_of(node);
  const rosidl_type_description_t* type = cache == nullptr ? nullptr : cache->find(type_hash);
  if (type == nullptr) {
    rcl_reset_error();
    return {{}, "Type not currently in use by this node"};
  }
  Types nested;
  add_nested_types(*type, nested);
  DescribedTypes result{{type}};
  for (const auto& [name, each] : nested) {
    result.types.push_back(each);
  }
  return result;
}

}  // namespace rcl
