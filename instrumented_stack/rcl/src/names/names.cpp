// SPDX-License-Identifier: Apache-2.0
#include "names/names.hpp"

#include <cctype>

#include "rcl/expand_topic_name.h"
#include "rcl/validate_topic_name.h"
#include "rmw/validate_full_topic_name.h"
#include "rmw/validate_namespace.h"
#include "rmw/validate_node_name.h"

namespace {

struct Verdict {
  int result;
  size_t index;
};

bool is_digit(char c) {
  return std::isdigit(static_cast<unsigned char>(c)) != 0;
}
bool is_name_character(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
}

// `open` is the position of a `{`. On success `open` moves to the `}`.
Verdict check_substitution(std::string_view name, size_t& open) {
  const size_t close = name.find('}', open);
  if (close == std::string_view::npos) {
    return {RCL_TOPIC_NAME_INVALID_UNMATCHED_CURLY_BRACE, open};
  }
  for (size_t i = open + 1; i < close; ++i) {
    if (!is_name_character(name[i])) {
      return {RCL_TOPIC_NAME_INVALID_SUBSTITUTION_CONTAINS_UNALLOWED_CHARACTERS, i};
    }
    if (i == open + 1 && is_digit(name[i])) {
      return {RCL_TOPIC_NAME_INVALID_SUBSTITUTION_STARTS_WITH_NUMBER, i};
    }
  }
  open = close;
  return {RCL_TOPIC_NAME_VALID, 0};
}

Verdict check_topic_name(std::string_view name) {
  if (name.empty()) {
    return {RCL_TOPIC_NAME_INVALID_IS_EMPTY_STRING, 0};
  }
  if (is_digit(name.front())) {
    return {RCL_TOPIC_NAME_INVALID_NAME_TOKEN_STARTS_WITH_NUMBER, 0};
  }
  if (name.back() == '/') {
    return {RCL_TOPIC_NAME_INVALID_ENDS_WITH_FORWARD_SLASH, name.size() - 1};
  }
  for (size_t i = 0; i < name.size(); ++i) {
    const char c = name[i];
    if (c == '{') {
      if (const Verdict verdict = check_substitution(name, i); verdict.result != RCL_TOPIC_NAME_VALID) {
        return verdict;
      }
    } else if (c == '}') {
      return {RCL_TOPIC_NAME_INVALID_UNMATCHED_CURLY_BRACE, i};
    } else if (c == '~') {
      if (i != 0) {
        return {RCL_TOPIC_NAME_INVALID_MISPLACED_TILDE, i};
      }
      if (name.size() > 1 && name[1] != '/') {
        return {RCL_TOPIC_NAME_INVALID_TILDE_NOT_FOLLOWED_BY_FORWARD_SLASH, 1};
      }
    } else if (c == '/') {
      if (i + 1 < name.size() && is_digit(name[i + 1])) {
        return {RCL_TOPIC_NAME_INVALID_NAME_TOKEN_STARTS_WITH_NUMBER, i + 1};
      }
    } else if (!is_name_character(c)) {
      return {RCL_TOPIC_NAME_INVALID_CONTAINS_UNALLOWED_CHARACTERS, i};
    }
  }
  return {RCL_TOPIC_NAME_VALID, 0};
}

}  // namespace

namespace rcl {

std::string fully_qualified_name(std::string_view node_namespace, std::string_view node_name) {
  std::string result(node_namespace);
  if (!result.ends_with('/')) {
    result += '/';
  }
  return result.append(node_name);
}

std::string expand_topic_name(std::string_view name, std::string_view node_name, std::string_view node_namespace,
                              const rcutils_string_map_t* substitutions) {
  if (const Verdict verdict = check_topic_name(name); verdict.result != RCL_TOPIC_NAME_VALID) {
    throw NameError(RCL_RET_TOPIC_NAME_INVALID, "invalid topic name '" + std::string(name) + "', at character " +
                                                    std::to_string(verdict.index + 1) + ": " +
                                                    rcl_topic_name_validation_result_string(verdict.result));
  }
  std::string result;
  if (name.front() == '~') {
    result = fully_qualified_name(node_namespace, node_name);
    name.remove_prefix(1);
  } else if (name.front() != '/' && !name.starts_with("{ns}") && !name.starts_with("{namespace}")) {
    result = fully_qualified_name(node_namespace, "");
  }
  for (size_t i = 0; i < name.size(); ++i) {
    if (name[i] != '{') {
      result += name[i];
      continue;
    }
    const size_t close = name.find('}', i);
    const std::string_view key = name.substr(i + 1, close - i - 1);
    if (key == "node") {
      result += node_name;
    } else if (key == "ns" || key == "namespace") {
      result += node_namespace;
    } else if (const char* value = substitutions == nullptr
                                       ? nullptr
                                       : rcutils_string_map_getn(substitutions, key.data(), key.size())) {
      result += value;
    } else {
      throw NameError(RCL_RET_UNKNOWN_SUBSTITUTION, "unknown substitution '{" + std::string(key) +
                                                        "}' in topic name: it may be {node}, {ns} or {namespace}");
    }
    i = close;
  }
  return result;
}

void check_full_topic_name(const std::string& name) {
  int result = RMW_TOPIC_VALID;
  size_t index = 0;
  if (rmw_validate_full_topic_name(name.c_str(), &result, &index) == RMW_RET_OK && result != RMW_TOPIC_VALID) {
    throw NameError(RCL_RET_TOPIC_NAME_INVALID, "invalid topic name '" + name + "', at character " +
                                                    std::to_string(index + 1) + ": " +
                                                    rmw_full_topic_name_validation_result_string(result));
  }
}

void check_node_names(const std::string& name, const std::string& node_namespace) {
  int verdict = RMW_NODE_NAME_VALID;
  if (rmw_validate_node_name(name.c_str(), &verdict, nullptr) != RMW_RET_OK || verdict != RMW_NODE_NAME_VALID) {
    throw NameError(RCL_RET_NODE_INVALID_NAME,
                    "invalid node name '" + name + "': " + rmw_node_name_validation_result_string(verdict));
  }
  if (rmw_validate_namespace(node_namespace.c_str(), &verdict, nullptr) != RMW_RET_OK ||
      verdict != RMW_NAMESPACE_VALID) {
    throw NameError(RCL_RET_NODE_INVALID_NAMESPACE,
                    "invalid namespace '" + node_namespace + "': " + rmw_namespace_validation_result_string(verdict));
  }
}

}  // namespace rcl

rcl_ret_t rcl_expand_topic_name(const char* input_topic_name, const char* node_name, const char* node_namespace,
                                const rcutils_string_map_t* substitutions, rcl_allocator_t allocator,
                                char** output_topic_name) try {
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(input_topic_name, RCL_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(node_name, RCL_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(node_namespace, RCL_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(substitutions, RCL_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(output_topic_name, RCL_RET_INVALID_ARGUMENT);
  rcl::check_node_names(node_name, node_namespace);
  return rcl::hand_out(rcl::expand_topic_name(input_topic_name, node_name, node_namespace, substitutions), allocator,
                       output_topic_name);
} catch (const rcl::NameError& error) {
  RCL_SET_ERROR_MSG(error.what());
  return error.code();
}

rcl_ret_t rcl_get_default_topic_name_substitutions(rcutils_string_map_t* string_map) {
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(string_map, RCL_RET_INVALID_ARGUMENT);
  return RCL_RET_OK;
}

rcl_ret_t rcl_validate_topic_name(const char* topic_name, int* validation_result, size_t* invalid_index) {
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(topic_name, RCL_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(validation_result, RCL_RET_INVALID_ARGUMENT);
  const Verdict verdict = check_topic_name(topic_name);
  *validation_result = verdict.result;
  if (invalid_index != nullptr && verdict.result != RCL_TOPIC_NAME_VALID) {
    *invalid_index = verdict.index;
  }
  return RCL_RET_OK;
}

const char* rcl_topic_name_validation_result_string(int validation_result) {
  switch (validation_result) {
    case RCL_TOPIC_NAME_VALID:
      return nullptr;
    case RCL_TOPIC_NAME_INVALID_IS_EMPTY_STRING:
      return "topic name must not be empty";
    case RCL_TOPIC_NAME_INVALID_ENDS_WITH_FORWARD_SLASH:
      return "topic name must not end with a '/'";
    case RCL_TOPIC_NAME_INVALID_CONTAINS_UNALLOWED_CHARACTERS:
      return "topic name must not contain characters other than letters, digits, '_', '/', '~', '{' and '}'";
    case RCL_TOPIC_NAME_INVALID_NAME_TOKEN_STARTS_WITH_NUMBER:
      return "a part of a topic name must not start with a number";
    case RCL_TOPIC_NAME_INVALID_UNMATCHED_CURLY_BRACE:
      return "topic name has a curly brace without its counterpart";
    case RCL_TOPIC_NAME_INVALID_MISPLACED_TILDE:
      return "a '~' may only be the first character of a topic name";
    case RCL_TOPIC_NAME_INVALID_TILDE_NOT_FOLLOWED_BY_FORWARD_SLASH:
      return "a '~' must be followed by a '/'";
    case RCL_TOPIC_NAME_INVALID_SUBSTITUTION_CONTAINS_UNALLOWED_CHARACTERS:
      return "a substitution must not contain characters other than letters, digits and '_'";
    case RCL_TOPIC_NAME_INVALID_SUBSTITUTION_STARTS_WITH_NUMBER:
      return "a substitution must not start with a number";
    default:
      return "unknown result of the check of a topic name";
  }
}
