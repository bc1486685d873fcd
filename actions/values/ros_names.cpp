// SPDX-License-Identifier: Apache-2.0
#include "actions/values/ros_names.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <vector>

namespace launch {

namespace {

// The configuration that holds the namespace of the scope.
constexpr const char* kNamespaceConfiguration = "ros_namespace";

bool is_valid_namespace(std::string_view text) {
  if (text == "/") {
    return true;
  }
  while (!text.empty()) {
    if (text.front() != '/') {
      return false;
    }
    text.remove_prefix(1);
    const std::size_t end = text.find('/');
    if (!is_valid_node_name(text.substr(0, end))) {
      return false;
    }
    text.remove_prefix(end == std::string_view::npos ? text.size() : end);
  }
  return true;
}

// Combines the namespace `given` with `base`: the result is absolute, without a slash at its end.
std::string combine_namespaces(const std::string& base, const std::string& given) {
  std::string combined;
  if (base.empty() || given.starts_with('/')) {
    combined = given;
  } else {
    combined = base == "/" ? "/" + given : base + "/" + given;
  }
  while (combined.size() > 1 && combined.ends_with('/')) {
    combined.pop_back();
  }
  return combined.starts_with('/') ? combined : "/" + combined;
}

}  // namespace

bool is_valid_node_name(std::string_view name) {
  if (name.empty() || std::isdigit(static_cast<unsigned char>(name.front()))) {
    return false;
  }
  for (const char character : name) {
    if (!std::isalnum(static_cast<unsigned char>(character)) && character != '_') {
      return false;
    }
  }
  return true;
}

std::optional<std::string> resolve_namespace(const std::optional<Template>& given, Scope& scope,
                                             const SourceRange& where) {
  const auto pushed = scope.configurations.find(kNamespaceConfiguration);
  const std::string base = pushed == scope.configurations.end() ? std::string() : pushed->second;
  if (!given && base.empty()) {
    return std::nullopt;
  }
  std::string combined = given ? combine_namespaces(base, given->perform(scope)) : combine_namespaces("", base);
  if (!is_valid_namespace(combined)) {
    throw LaunchError(fmt::format("the resulting namespace is invalid: '{}'", combined), given ? given->where() : where,
                      "each part is letters, digits and underscores, not starting with a digit", Finding::kInvalidName);
  }
  return combined;
}

void push_namespace(const Template& given, Scope& scope) {
  scope.configurations.insert_or_assign(kNamespaceConfiguration, *resolve_namespace(given, scope, given.where()));
}

std::optional<std::string> pushed_namespace(const Scope& scope) {
  const auto pushed = scope.configurations.find(kNamespaceConfiguration);
  return pushed == scope.configurations.end() ? std::nullopt : std::optional(pushed->second);
}

void restore_namespace(const std::optional<std::string>& pushed, Scope& scope) {
  if (pushed) {
    scope.configurations.insert_or_assign(kNamespaceConfiguration, *pushed);
  } else {
    scope.configurations.erase(kNamespaceConfiguration);
  }
}

std::string resolve_name(const Template& given, Scope& scope) {
  return resolve_name(given.perform(scope), scope, given.where());
}

std::string resolve_name(const std::string& text, const Scope& scope, const SourceRange& where) {
  const auto pushed = scope.configurations.find(kNamespaceConfiguration);
  const std::string name = combine_namespaces(pushed == scope.configurations.end() ? "" : pushed->second, text);
  if (text.empty() || text.ends_with('/') || !is_valid_namespace(name)) {
    throw LaunchError(fmt::format("'{}' is no valid name", text), where,
                      "each part is letters, digits and underscores, not starting with a digit", Finding::kInvalidName);
  }
  return name;
}

std::string qualified_name(const std::string& name_space, const std::string& name) {
  return (name_space == "/" ? "" : name_space) + "/" + name;
}

void require_transition(const std::string& name, const SourceRange& where) {
  static const std::vector<std::string> transitions = {"configure", "activate", "deactivate", "cleanup", "shutdown"};
  if (std::find(transitions.begin(), transitions.end(), name) == transitions.end()) {
    throw LaunchError(
        fmt::format("there is no transition '{}', expected configure, activate, deactivate, cleanup or shutdown", name),
        where, did_you_mean(name, transitions));
  }
}

}  // namespace launch
