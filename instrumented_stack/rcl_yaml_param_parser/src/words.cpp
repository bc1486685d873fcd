// SPDX-License-Identifier: Apache-2.0
#include "words.hpp"

#include <rmw/validate_namespace.h>
#include <rmw/validate_node_name.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <clocale>
#include <cstdlib>
#include <optional>
#include <string_view>

namespace rcl_yaml {
namespace {

std::optional<bool> as_bool(std::string_view text) {
  constexpr std::array<std::string_view, 11> kTrue{"y",    "Y",    "yes", "Yes", "YES", "true",
                                                   "True", "TRUE", "on",  "On",  "ON"};
  constexpr std::array<std::string_view, 11> kFalse{"n",     "N",     "no",  "No",  "NO", "false",
                                                    "False", "FALSE", "off", "Off", "OFF"};
  if (std::find(kTrue.begin(), kTrue.end(), text) != kTrue.end()) {
    return true;
  }
  if (std::find(kFalse.begin(), kFalse.end(), text) != kFalse.end()) {
    return false;
  }
  return std::nullopt;
}

std::optional<std::int64_t> as_int(const std::string& text) {
  char* end = nullptr;
  errno = 0;
  const long long value = std::strtoll(text.c_str(), &end, 0);
  if (text.empty() || errno != 0 || end != text.c_str() + text.size()) {
    return std::nullopt;
  }
  return value;
}

// A program may have set a locale that writes decimals with a comma, as user interfaces do.
double to_double(const char* text, char** end) {
  static const locale_t kC = newlocale(LC_ALL_MASK, "C", nullptr);
  return strtod_l(text, end, kC);
}

std::optional<double> as_double(const std::string& text) {
  // YAML writes `.inf` and `.nan`; strtod expects `inf` and `nan`. Only these ways to write them are numbers.
  constexpr std::array<std::string_view, 12> kSpecial{".nan",  ".NaN",  ".NAN",  ".inf",  ".Inf",  ".INF",
                                                      "+.inf", "+.Inf", "+.INF", "-.inf", "-.Inf", "-.INF"};
  std::string number = text;
  if (std::find(kSpecial.begin(), kSpecial.end(), text) != kSpecial.end()) {
    number.erase(number.find('.'), 1);
  }
  char* end = nullptr;
  errno = 0;
  const double value = to_double(number.c_str(), &end);
  if (number.empty() || errno != 0 || end != number.c_str() + number.size()) {
    return std::nullopt;
  }
  return value;
}

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

Scalar typed_scalar(std::string text) {
  if (const auto value = as_bool(text)) {
    return *value;
  }
  if (const auto value = as_int(text)) {
    return *value;
  }
  if (const auto value = as_double(text)) {
    return *value;
  }
  return text;
}

const char* type_name(const Scalar& value) {
  constexpr std::array<const char*, 4> kNames{"bool", "integer", "double", "string"};
  return kNames[value.index()];
}

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
