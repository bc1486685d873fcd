// SPDX-License-Identifier: Apache-2.0
// Finds the prefix in which a package is installed.
#pragma once

#include <stdexcept>
#include <string>

namespace ament_index_cpp {

// what() names the package and every prefix that was searched.
class PackageNotFoundError : public std::out_of_range {
 public:
  explicit PackageNotFoundError(const std::string& package_name);

  const std::string package_name;
};

// Throws PackageNotFoundError; std::runtime_error for an empty name.
std::string get_package_prefix(const std::string& package_name);

}  // namespace ament_index_cpp
