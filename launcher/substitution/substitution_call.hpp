// SPDX-License-Identifier: Apache-2.0
// One use of a built-in substitution while it is performed, and the functions that perform them.
#pragma once

#include <fmt/format.h>

#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "launcher/substitution/boolean.hpp"
#include "launcher/substitution/package_index.hpp"
#include "launcher/substitution/substitution.hpp"

namespace launch {

class SubstitutionCall {
 public:
  SubstitutionCall(const std::vector<Template>& arguments, const SourceRange& where, Scope& scope)
      : arguments_(arguments), where_(where), scope_(scope) {}

  std::size_t count() const { return arguments_.size(); }
  bool has(std::size_t index) const { return index < arguments_.size(); }

  // The text of an argument; performed anew by each call. Throws LaunchError when there is none.
  std::string text(std::size_t index) const {
    if (!has(index)) {
      fail(fmt::format("argument {} of the substitution is missing", index + 1), {});
    }
    return arguments_[index].perform(scope_);
  }

  bool boolean(std::size_t index) const {
    const std::string value = text(index);
    const std::optional<bool> result = yaml_boolean(value);
    if (!result) {
      throw LaunchError(fmt::format("'{}' is not a boolean", value), arguments_[index].where(),
                        "expected true, false, yes, no, on, off, 1 or 0", Finding::kWrongType);
    }
    return *result;
  }

  [[noreturn]] void fail(std::string message, std::string help, Finding finding = Finding::kNone) const {
    throw LaunchError(std::move(message), where_, std::move(help), finding);
  }

  // Runs a look-up of a package, whose errors have no place, and gives them this one.
  template <typename LookUp>
  std::string look_up_package(LookUp find, const std::string& package) const {
    try {
      return find(*scope_.packages);
    } catch (const std::runtime_error& error) {
      fail(error.what(), scope_.packages->help_for_missing(package, scope_.environment), Finding::kMissingPackage);
    }
  }

  // Runs a look-up of the package index, whose errors have no place, and gives them this one.
  template <typename LookUp, typename Candidates>
  std::string look_up(LookUp find, std::string_view name, Candidates candidates, Finding finding) const {
    try {
      return find(*scope_.packages);
    } catch (const std::runtime_error& error) {
      fail(error.what(), did_you_mean(name, candidates(*scope_.packages)), finding);
    }
  }

  Scope& scope() const { return scope_; }
  const SourceRange& where() const { return where_; }
  // The place of an argument, or of the substitution when there is no such argument.
  const SourceRange& where(std::size_t index) const { return has(index) ? arguments_[index].where() : where_; }

 private:
  const std::vector<Template>& arguments_;
  const SourceRange& where_;
  Scope& scope_;
};

// The names of a map, for suggestions.
template <typename Map>
std::vector<std::string> names_of(const Map& map) {
  std::vector<std::string> names;
  for (const auto& [name, value] : map) {
    names.push_back(name);
  }
  return names;
}

// In outside_substitutions.cpp: the substitutions that look beyond the launch files.
std::string command(const SubstitutionCall& call);
std::string eval(const SubstitutionCall& call);
std::string file_content(const SubstitutionCall& call);
std::string anon(const SubstitutionCall& call);

}  // namespace launch
