// SPDX-License-Identifier: Apache-2.0
#include "words.hpp"

#include <rmw/validate_namespace.h>
#include <rmw/validate_node_name.h>

namespace rcl_yaml {
namespace {

bool is_wildcard(const std::string& level) {
  return level == "*" || level == "**";
}

std::string wrong_in_level(const std::string& level) {
  int result = RMW_NAMESPACE_VALID;
  if (rmw_validate_namespace(("/" + level).c_str(), &result, nullptr) != RMW_RET_OK) {
    return "it cannot be checked";
  }
  return result == RMW_NAMESPACE_VALID ? "" : rmw_namespace_validation_result_string(result);
}

std::string wrong_in_name(const std::string& name) {
  int result = RMW_NODE_NAME_VALID;
  if (rmw_validate_node_name(name.c_str(), &result, nullptr) != RMW_RET_OK) {
    return "it cannot be checked";
  }
  return result == RMW_NODE_NAME_VALID ? "" : rmw_node_name_validation_result_string(result);
}

}  // namespace

std::string wrong_in_node_pattern(const std::string& pattern) {
  std::size_t begin = pattern.starts_with('/') ? 1 : 0;
  for (std::size_t end = pattern.find('/', begin); end != std::string::npos; end = pattern.find('/', begin)) {
    const std::string level = pattern.substr(begin, end - begin);
    if (level.empty()) {
      return "it has two slashes in a row";
    }
    if (std::string problem = is_wildcard(level) ? "" : wrong_in_level(level); !problem.empty()) {
      return problem;
    }
    begin = end + 1;
  }
  const std::string name = pattern.substr(begin);
  return is_wildcard(name) ? "" : wrong_in_name(name);
}

}  // namespace rcl_yaml
