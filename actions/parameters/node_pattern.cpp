// SPDX-License-Identifier: Apache-2.0
#include "actions/parameters/node_pattern.hpp"

#include <algorithm>
#include <span>
#include <vector>

#include "actions/values/ros_names.hpp"

namespace launch {

namespace {

// "/a/b" and "a/b" have the parts a and b.
std::vector<std::string_view> parts_of(std::string_view name) {
  std::vector<std::string_view> parts;
  while (!name.empty()) {
    const std::size_t end = std::min(name.find('/'), name.size());
    if (end > 0) {
      parts.push_back(name.substr(0, end));
    }
    name.remove_prefix(std::min(end + 1, name.size()));
  }
  return parts;
}

constexpr std::string_view kAnyName = "?";

// "*" stands for one part, "**" for any number.
bool matches(std::span<const std::string_view> pattern, std::span<const std::string_view> name) {
  if (pattern.empty()) {
    return name.empty();
  }
  if (pattern.front() == "**") {
    return matches(pattern.subspan(1), name) || (!name.empty() && matches(pattern, name.subspan(1)));
  }
  return !name.empty() && (pattern.front() == "*" || pattern.front() == name.front() || name.front() == kAnyName) &&
         matches(pattern.subspan(1), name.subspan(1));
}

}  // namespace

bool is_valid_node_pattern(std::string_view pattern) {
  pattern.remove_prefix(pattern.starts_with('/') ? 1 : 0);
  while (true) {
    const std::size_t slash = pattern.find('/');
    const std::string_view part = pattern.substr(0, slash);
    if (part != "*" && part != "**" && !is_valid_node_name(part)) {
      return false;
    }
    if (slash == std::string_view::npos) {
      return true;
    }
    pattern.remove_prefix(slash + 1);
  }
}

bool is_for_node(std::string_view pattern, std::string_view full_name) {
  return matches(parts_of(pattern), parts_of(full_name));
}

bool is_for_namespace(std::string_view pattern, std::string_view name_space) {
  std::vector<std::string_view> name = parts_of(name_space);
  name.push_back(kAnyName);
  return matches(parts_of(pattern), name);
}

}  // namespace launch
