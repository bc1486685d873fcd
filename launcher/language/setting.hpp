// SPDX-License-Identifier: Apache-2.0
// A setting of an action: an attribute, and the place in a struct that its value goes to. A row says all of it once:
//
//   {.attribute = {"append-trace", AttributeType::kBoolean, false, "false", "allow a trace directory that exists"},
//    .place = [](Request& request) -> SettingPlace { return &request.config.append_trace; },
//    .shown = "append-trace",
//    .option = {"-a,--append-trace", "", "add to a trace directory that exists already"}}
//
// From the rows come the declaration of the attributes (declared_attributes), the checks when a file is loaded
// (check_settings), the evaluation (perform_settings), what a dry run shows (shown_settings), and the options of a
// command that has the same settings. An action keeps its Fields and performs the rows when it is visited.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "launcher/language/fields.hpp"
#include "launcher/language/registry.hpp"
#include "launcher/substitution/scope.hpp"

namespace launch {

// One of several words. The number of the word is its value.
struct SettingChoice {
  std::vector<std::string> words;
  std::size_t chosen;
  std::function<void(std::size_t)> choose;
};

// A number that must not be negative.
struct NumberFromZero {
  double* number;
};

// Where the value of a setting goes. The type tells how it is read: numbers without a sign must not be negative, those
// of 32 bits are at most the largest one (LTTng's timers), times are given in seconds, texts of a list may hold several
// words.
using SettingPlace = std::variant<bool*, std::optional<bool>*, std::int64_t*, std::uint64_t*, std::uint32_t*,
                                  std::optional<std::uint64_t>*, std::optional<std::uint32_t>*, double*, NumberFromZero,
                                  std::chrono::nanoseconds*, std::optional<std::chrono::nanoseconds>*, std::string*,
                                  std::vector<std::string>*, SettingChoice>;

std::chrono::nanoseconds as_duration(double seconds);

// The place of a member of the struct, or of a member of one of its parts.
template <typename Struct, typename Member>
auto place_of(Member Struct::*member) {
  return [member](Struct& target) -> SettingPlace { return &(target.*member); };
}
template <typename Struct, typename Part, typename Owner, typename Member>
auto place_of(Part Struct::*part, Member Owner::*member) {
  return [part, member](Struct& target) -> SettingPlace { return &(target.*part.*member); };
}

// An evaluated setting, for people and programs.
using SettingValue = std::variant<bool, std::int64_t, std::string, std::vector<std::string>>;
struct ShownSetting {
  std::string name;
  SettingValue value;
};

// The option of a command line with the same meaning. Without flags there is none.
struct SettingOption {
  std::string flags = {};  // "-u,--ust"
  std::string unit = {};   // "BYTES"
  std::string help = {};
};

// A row has a place, a function of its own, or both. One without is a declaration: its action reads the field itself.
template <typename Target>
struct Setting {
  AttributeSpec attribute;  // without a name: only shown
  std::function<SettingPlace(Target&)> place;
  // Instead of reading the value into its place, for values with a rule of their own. Called if the attribute is given.
  std::function<void(const Fields&, Scope&, Target&)> perform;
  std::string shown = {};                           // the name in a dry run; empty: not shown
  std::function<SettingValue(const Target&)> show;  // instead of the value at the place
  SettingOption option;
  // `perform` is also called when the file is loaded, to tell what is wrong with a text without substitutions.
  bool checks_literal = false;
};

// The parts of the functions below that do not depend on the struct.
void check_setting(const AttributeSpec& attribute, const Fields& fields, const SettingPlace& place);
bool is_literal(const AttributeSpec& attribute, const Fields& fields);
void perform_setting(const AttributeSpec& attribute, const Fields& fields, Scope& scope, const SettingPlace& place);
SettingValue shown_value(const SettingPlace& place);

// The texts of an attribute of kWords, without empty ones that empty substitutions leave.
std::vector<std::string> perform_words(const Fields& fields, std::string_view attribute, Scope& scope);
std::vector<std::string> split_names(const std::string& text);  // at blanks
// The same as perform_words, each text split at blanks: a substitution may give several words, as in
// context-fields="$(var fields)".
std::vector<std::string> perform_names(const Fields& fields, std::string_view attribute, Scope& scope);

template <typename Target>
std::vector<AttributeSpec> declared_attributes(const std::vector<Setting<Target>>& settings) {
  std::vector<AttributeSpec> attributes;
  for (const Setting<Target>& setting : settings) {
    if (!setting.attribute.name.empty()) {
      attributes.push_back(setting.attribute);
    }
  }
  return attributes;
}

// Throws LaunchError for values that are wrong whatever a visit brings.
template <typename Target>
void check_settings(const std::vector<Setting<Target>>& settings, const Fields& fields) {
  Target nothing{};
  for (const Setting<Target>& setting : settings) {
    if (!fields.has(setting.attribute.name)) {
      continue;
    }
    if (setting.place) {
      check_setting(setting.attribute, fields, setting.place(nothing));
    }
    if (setting.checks_literal && is_literal(setting.attribute, fields)) {
      Scope without_substitutions;
      setting.perform(fields, without_substitutions, nothing);
    }
  }
}

// Evaluates what is given, in the order of the rows; the rest of the target stays as it is. Throws LaunchError.
template <typename Target>
void perform_settings(const std::vector<Setting<Target>>& settings, const Fields& fields, Scope& scope,
                      Target& target) {
  for (const Setting<Target>& setting : settings) {
    if (!fields.has(setting.attribute.name)) {
      continue;
    }
    if (setting.perform) {
      setting.perform(fields, scope, target);
    } else if (setting.place) {
      perform_setting(setting.attribute, fields, scope, setting.place(target));
    }
  }
}

template <typename Target>
std::vector<ShownSetting> shown_settings(const std::vector<Setting<Target>>& settings, Target target) {
  std::vector<ShownSetting> shown;
  for (const Setting<Target>& setting : settings) {
    if (!setting.shown.empty()) {
      shown.push_back({setting.shown, setting.show ? setting.show(target) : shown_value(setting.place(target))});
    }
  }
  return shown;
}

}  // namespace launch
