// SPDX-License-Identifier: Apache-2.0
#include "ament_index_cpp/get_package_prefix.hpp"
#include "ament_index_cpp/get_package_share_directory.hpp"
#include "ament_index_cpp/get_packages_with_prefixes.hpp"
#include "ament_index_cpp/get_resources.hpp"
#include "ament_index_cpp/get_search_paths.hpp"
#include "ament_index_cpp/has_resource.hpp"

namespace ament_index_cpp {

namespace {

constexpr const char* kPackages = "packages";

std::string not_found(const std::string& package_name) {
  std::string text = "package '" + package_name + "' not found, searching: [";
  const char* separator = "";
  for (const std::string& prefix : get_search_paths()) {
    text += separator + prefix;
    separator = ", ";
  }
  return text + "]";
}

}  // namespace

PackageNotFoundError::PackageNotFoundError(const std::string& name)
    : std::out_of_range(not_found(name)), package_name(name) {}

std::string get_package_prefix(const std::string& package_name) {
  std::string prefix;
  if (!has_resource(kPackages, package_name, &prefix)) {
    throw PackageNotFoundError(package_name);
  }
  return prefix;
}

std::filesystem::path get_package_share_path(const std::string& package_name) {
  return std::filesystem::path(get_package_prefix(package_name)) / "share" / package_name;
}

std::string get_package_share_directory(const std::string& package_name) {
  return get_package_share_path(package_name).string();
}

std::map<std::string, std::string> get_packages_with_prefixes() {
  return get_resources(kPackages);
}

}  // namespace ament_index_cpp
