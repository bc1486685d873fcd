// SPDX-License-Identifier: Apache-2.0
// Finds packages and their programs through the ament index.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "launcher/substitution/scope.hpp"

namespace launch {

// All look-ups take the launch environment, whose AMENT_PREFIX_PATH is searched in order. When the variable is unset or
// lacks the package, the prefix that this launcher is installed in is searched last, so that its own packages are found
// with no ROS 2 set up. Functions throw std::runtime_error with a message of one line, to which the caller adds the
// place.
class PackageIndex {
 public:
  // `own_prefix` is searched after AMENT_PREFIX_PATH; empty for none.
  explicit PackageIndex(std::string own_prefix = {});
  virtual ~PackageIndex() = default;

  virtual std::string prefix(const std::string& package, const Environment& environment);
  // PREFIX/share/PACKAGE.
  std::string share(const std::string& package, const Environment& environment);
  // Path of program `executable` in PREFIX/lib/PACKAGE.
  virtual std::string executable(const std::string& executable, const std::string& package,
                                 const Environment& environment);

  // Names of all packages that can be found, for suggestions.
  virtual std::vector<std::string> packages(const Environment& environment) const;
  // What to do about a package that is not found: its right name, or where packages are searched.
  virtual std::string help_for_missing(const std::string& package, const Environment& environment) const;
  // Names of all programs of a package, for suggestions. Throws as prefix() does.
  virtual std::vector<std::string> executables(const std::string& package, const Environment& environment);

  // The path of a program on PATH of the environment. A name with a slash is taken as a path. Empty when there is none.
  virtual std::string find_program(const std::string& name, const Environment& environment) {
    return find_on_path(name, environment);
  }
  // The same on this machine.
  static std::string find_on_path(const std::string& name, const Environment& environment);

 private:
  std::string own_prefix_;
  std::map<std::string, std::string> cache_;  // search path + name -> prefix
};

}  // namespace launch
