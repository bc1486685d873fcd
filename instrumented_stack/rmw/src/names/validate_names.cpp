// SPDX-License-Identifier: Apache-2.0
// The rules for names, as in ROS 2's rmw: names that DDS can carry and other tools expect.
#include <cctype>
#include <cstring>
#include <string_view>

#include "rmw/error_handling.h"
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

Verdict check_full_topic_name(std::string_view name) {
  if (name.empty()) {
    return {RMW_TOPIC_INVALID_IS_EMPTY_STRING, 0};
  }
  if (name.front() != '/') {
    return {RMW_TOPIC_INVALID_NOT_ABSOLUTE, 0};
  }
  if (name.back() == '/') {
    return {RMW_TOPIC_INVALID_ENDS_WITH_FORWARD_SLASH, name.size() - 1};
  }
  for (size_t i = 0; i < name.size(); ++i) {
    if (!is_name_character(name[i]) && name[i] != '/') {
      return {RMW_TOPIC_INVALID_CONTAINS_UNALLOWED_CHARACTERS, i};
    }
  }
  for (size_t i = 1; i < name.size(); ++i) {
    if (name[i - 1] == '/' && name[i] == '/') {
      return {RMW_TOPIC_INVALID_CONTAINS_REPEATED_FORWARD_SLASH, i};
    }
    if (name[i - 1] == '/' && is_digit(name[i])) {
      return {RMW_TOPIC_INVALID_NAME_TOKEN_STARTS_WITH_NUMBER, i};
    }
  }
  if (name.size() > RMW_TOPIC_MAX_NAME_LENGTH) {
    return {RMW_TOPIC_INVALID_TOO_LONG, RMW_TOPIC_MAX_NAME_LENGTH - 1};
  }
  return {RMW_TOPIC_VALID, 0};
}

// A namespace has the form of a topic name, or is the root. Both use the same numbers for their codes.
Verdict check_namespace(std::string_view name) {
  if (name == "/") {
    return {RMW_NAMESPACE_VALID, 0};
  }
  const Verdict verdict = check_full_topic_name(name);
  if (verdict.result == RMW_TOPIC_VALID && name.size() > RMW_NAMESPACE_MAX_LENGTH) {
    return {RMW_NAMESPACE_INVALID_TOO_LONG, RMW_NAMESPACE_MAX_LENGTH - 1};
  }
  return verdict;
}

Verdict check_node_name(std::string_view name) {
  if (name.empty()) {
    return {RMW_NODE_NAME_INVALID_IS_EMPTY_STRING, 0};
  }
  for (size_t i = 0; i < name.size(); ++i) {
    if (!is_name_character(name[i])) {
      return {RMW_NODE_NAME_INVALID_CONTAINS_UNALLOWED_CHARACTERS, i};
    }
  }
  if (is_digit(name.front())) {
    return {RMW_NODE_NAME_INVALID_STARTS_WITH_NUMBER, 0};
  }
  if (name.size() > RMW_NODE_NAME_MAX_NAME_LENGTH) {
    return {RMW_NODE_NAME_INVALID_TOO_LONG, RMW_NODE_NAME_MAX_NAME_LENGTH - 1};
  }
  return {RMW_NODE_NAME_VALID, 0};
}

rmw_ret_t report(Verdict (*check)(std::string_view), const char* name, int* result, size_t* index) {
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(name, RMW_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(result, RMW_RET_INVALID_ARGUMENT);
  const Verdict verdict = check(name);
  *result = verdict.result;
  if (index != nullptr && verdict.result != 0) {
    *index = verdict.index;
  }
  return RMW_RET_OK;
}

}  // namespace

rmw_ret_t rmw_validate_full_topic_name(const char* topic_name, int* validation_result, size_t* invalid_index) {
  return report(check_full_topic_name, topic_name, validation_result, invalid_index);
}

const char* rmw_full_topic_name_validation_result_string(int validation_result) {
  switch (validation_result) {
    case RMW_TOPIC_VALID:
      return nullptr;
    case RMW_TOPIC_INVALID_IS_EMPTY_STRING:
      return "topic name must not be empty";
    case RMW_TOPIC_INVALID_NOT_ABSOLUTE:
      return "topic name must be absolute: it must begin with a '/'";
    case RMW_TOPIC_INVALID_ENDS_WITH_FORWARD_SLASH:
      return "topic name must not end with a '/'";
    case RMW_TOPIC_INVALID_CONTAINS_UNALLOWED_CHARACTERS:
      return "topic name must not contain characters other than letters, digits, '_' and '/'";
    case RMW_TOPIC_INVALID_CONTAINS_REPEATED_FORWARD_SLASH:
      return "topic name must not have '//'";
    case RMW_TOPIC_INVALID_NAME_TOKEN_STARTS_WITH_NUMBER:
      return "a part of a topic name must not start with a number";
    case RMW_TOPIC_INVALID_TOO_LONG:
      return "topic name must not be longer than 247 characters";
    default:
      return "unknown result of the check of a topic name";
  }
}

rmw_ret_t rmw_validate_namespace(const char* namespace_, int* validation_result, size_t* invalid_index) {
  return report(check_namespace, namespace_, validation_result, invalid_index);
}

const char* rmw_namespace_validation_result_string(int validation_result) {
  switch (validation_result) {
    case RMW_NAMESPACE_VALID:
      return nullptr;
    case RMW_NAMESPACE_INVALID_IS_EMPTY_STRING:
      return "namespace must not be empty";
    case RMW_NAMESPACE_INVALID_NOT_ABSOLUTE:
      return "namespace must be absolute: it must begin with a '/'";
    case RMW_NAMESPACE_INVALID_ENDS_WITH_FORWARD_SLASH:
      return "namespace must not end with a '/', unless it is only that";
    case RMW_NAMESPACE_INVALID_CONTAINS_UNALLOWED_CHARACTERS:
      return "namespace must not contain characters other than letters, digits, '_' and '/'";
    case RMW_NAMESPACE_INVALID_CONTAINS_REPEATED_FORWARD_SLASH:
      return "namespace must not have '//'";
    case RMW_NAMESPACE_INVALID_NAME_TOKEN_STARTS_WITH_NUMBER:
      return "a part of a namespace must not start with a number";
    case RMW_NAMESPACE_INVALID_TOO_LONG:
      return "namespace must not be longer than 245 characters";
    default:
      return "unknown result of the check of a namespace";
  }
}

rmw_ret_t rmw_validate_node_name(const char* node_name, int* validation_result, size_t* invalid_index) {
  return report(check_node_name, node_name, validation_result, invalid_index);
}

const char* rmw_node_name_validation_result_string(int validation_result) {
  switch (validation_result) {
    case RMW_NODE_NAME_VALID:
      return nullptr;
    case RMW_NODE_NAME_INVALID_IS_EMPTY_STRING:
      return "node name must not be empty";
    case RMW_NODE_NAME_INVALID_CONTAINS_UNALLOWED_CHARACTERS:
      return "node name must not contain characters other than letters, digits and '_'";
    case RMW_NODE_NAME_INVALID_STARTS_WITH_NUMBER:
      return "node name must not start with a number";
    case RMW_NODE_NAME_INVALID_TOO_LONG:
      return "node name must not be longer than 255 characters";
    default:
      return "unknown result of the check of a node name";
  }
}
