// SPDX-License-Identifier: Apache-2.0
#include "rcl/parameter_overrides.hpp"

#include <algorithm>

#include "arguments/arguments_impl.hpp"

namespace rcl {
namespace {

// Both begin with a slash. `*` matches one level of a name, `**` any number of levels, including none.
bool matches(std::string_view pattern, std::string_view name) {
  if (pattern.empty()) {
    return name.empty();
  }
  const auto next_level = [](std::string_view text) { return text.substr(0, text.find('/', 1)); };
  const std::string_view level = next_level(pattern);
  const std::string_view rest = pattern.substr(level.size());
  if (level == "/**") {
    for (std::string_view tail = name;; tail.remove_prefix(next_level(tail).size())) {
      if (matches(rest, tail)) {
        return true;
      }
      if (tail.empty()) {
        return false;
      }
    }
  }
  if (name.empty()) {
    return false;
  }
  const std::string_view name_level = next_level(name);
  return (level == "/*" || level == name_level) && matches(rest, name.substr(name_level.size()));
}

std::string with_slash(std::string_view pattern) {
  return pattern.starts_with('/') ? std::string(pattern) : "/" + std::string(pattern);
}

ParameterOverrides::Value value_or_error(std::optional<ParameterValue> value, std::string_view name,
                                         const std::string& prefix) {
  if (value.has_value()) {
    return *std::move(value);
  }
  return NoValue{prefix + "parameter '" + std::string(name) + "' is an empty list, which has no type"};
}

// Collects what a file has.
class IntoOverrides : public rcl_yaml::ParameterSink {
 public:
  explicit IntoOverrides(ParameterOverrides& target) : target_(target) {}

  void add_node(const std::string& node) override { node_ = node; }
  void add_parameter(const std::string& name, std::optional<ParameterValue> value, const std::string& place) override {
    target_.set(node_, name, value_or_error(std::move(value), name, place + ": "));
  }

 private:
  ParameterOverrides& target_;
  std::string node_;
};

}  // namespace

bool node_pattern_matches(std::string_view pattern, std::string_view fully_qualified_name) {
  return matches(with_slash(pattern), fully_qualified_name);
}

void ParameterOverrides::set(std::string_view node_pattern, std::string_view name, Value value) {
  std::string pattern = with_slash(node_pattern);
  auto entry =
      std::find_if(patterns_.begin(), patterns_.end(), [&](const auto& known) { return known.first == pattern; });
  if (entry == patterns_.end()) {
    entry = patterns_.emplace(patterns_.end(), std::move(pattern), Values());
  }
  Values& values = entry->second;
  const auto known = std::find_if(values.begin(), values.end(), [&](const auto& old) { return old.first == name; });
  if (known == values.end()) {
    values.emplace_back(name, std::move(value));
  } else {
    known->second = std::move(value);
  }
}

void ParameterOverrides::load_file(const std::string& path) {
  load_text(rcl_yaml::read_file(path), path);
}

void ParameterOverrides::load_text(std::string text, const std::string& path) {
  // The values are applied only if the whole file is valid.
  ParameterOverrides read;
  IntoOverrides sink(read);
  rcl_yaml::read_parameters(std::move(text), path, sink);
  merge(read);
}

void ParameterOverrides::set_from_text(std::string_view node_pattern, std::string_view name, std::string_view text) {
  auto value = rcl_yaml::read_value(std::string(text), std::string(name));
  set(node_pattern, name, value_or_error(std::move(value), name, ""));
}

void ParameterOverrides::merge(const ParameterOverrides& other) {
  for (const auto& [pattern, values] : other.patterns_) {
    for (const auto& [name, value] : values) {
      set(pattern, name, value);
    }
  }
}

std::map<std::string, ParameterValue> ParameterOverrides::for_node(std::string_view fully_qualified_name) const {
  std::map<std::string, ParameterValue> result;
  for (const auto& [pattern, values] : patterns_) {
    if (matches(pattern, fully_qualified_name)) {
      for (const auto& [name, value] : values) {
        if (const auto* missing = std::get_if<NoValue>(&value)) {
          wrong(missing->error);
        }
        result.insert_or_assign(name, std::get<ParameterValue>(value));
      }
    }
  }
  return result;
}

const ParameterOverrides& parameter_overrides(const rcl_arguments_t& arguments) {
  static const ParameterOverrides kNone;
  return arguments.impl == nullptr ? kNone : arguments.impl->parameters;
}

}  // namespace rcl
