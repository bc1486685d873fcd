// SPDX-License-Identifier: Apache-2.0
#include "launcher/substitution/package_index.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <set>
#include <stdexcept>
#include <string_view>
#include <system_error>
#include <utility>

#include "base/diagnostics/diagnostic.hpp"

namespace launch {

namespace {

namespace fs = std::filesystem;

constexpr const char* kSearchPathVariable = "AMENT_PREFIX_PATH";
constexpr std::string_view kPackageMarkers = "share/ament_index/resource_index/packages";

std::vector<std::string> split_path(std::string_view list) {
  std::vector<std::string> entries;
  while (true) {
    const std::size_t colon = list.find(':');
    entries.emplace_back(list.substr(0, colon));
    if (colon == std::string_view::npos) {
      return entries;
    }
    list.remove_prefix(colon + 1);
  }
}

std::string variable(const Environment& environment, const std::string& name) {
  const auto found = environment.find(name);
  return found == environment.end() ? std::string() : found->second;
}

// [a-zA-Z0-9][a-zA-Z0-9_-]+, the names that the ament index takes.
bool is_package_name(std::string_view name) {
  const auto is_word = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
  };
  return name.size() >= 2 && is_word(name.front()) &&
         std::all_of(name.begin(), name.end(), [&](char c) { return is_word(c) || c == '_' || c == '-'; });
}

bool is_program(const std::string& path) {
  std::error_code error;
  return fs::is_regular_file(path, error) && ::access(path.c_str(), X_OK) == 0;
}

// Existing prefixes in the order of search, each once, `own_prefix` last.
std::vector<std::string> search_path(const Environment& environment, const std::string& own_prefix) {
  std::vector<std::string> prefixes;
  std::error_code error;
  const auto add = [&prefixes](std::string prefix) {
    if (!prefix.empty() && std::find(prefixes.begin(), prefixes.end(), prefix) == prefixes.end()) {
      prefixes.push_back(std::move(prefix));
    }
  };
  for (std::string& entry : split_path(variable(environment, kSearchPathVariable))) {
    if (fs::is_directory(entry, error)) {
      add(std::move(entry));
    }
  }
  add(own_prefix);
  return prefixes;
}

std::vector<std::string> file_names(const std::string& directory) {
  std::vector<std::string> names;
  std::error_code error;
  for (fs::directory_iterator entry(directory, error), end; entry != end && !error; entry.increment(error)) {
    names.push_back(entry->path().filename().string());
  }
  return names;
}

}  // namespace

PackageIndex::PackageIndex(std::string own_prefix) : own_prefix_(std::move(own_prefix)) {}

std::string PackageIndex::prefix(const std::string& package, const Environment& environment) {
  const std::string key = fmt::format("{}\n{}", variable(environment, kSearchPathVariable), package);
  if (const auto found = cache_.find(key); found != cache_.end()) {
    return found->second;
  }
  if (!is_package_name(package)) {
    throw std::runtime_error(fmt::format("'{}' is not a valid package name", package));
  }
  if (own_prefix_.empty() && variable(environment, kSearchPathVariable).empty()) {
    throw std::runtime_error(fmt::format("package '{}' not found: environment variable '{}' is not set or empty",
                                         package, kSearchPathVariable));
  }
  const std::vector<std::string> prefixes = search_path(environment, own_prefix_);
  for (const std::string& candidate : prefixes) {
    std::error_code error;
    if (fs::is_regular_file(fmt::format("{}/{}/{}", candidate, kPackageMarkers, package), error)) {
      return cache_[key] = candidate;
    }
  }
  std::string searched;
  for (const std::string& candidate : prefixes) {
    searched += fmt::format("{}'{}'", searched.empty() ? "" : ", ", candidate);
  }
  throw std::runtime_error(fmt::format("package '{}' not found, searching: [{}]", package, searched));
}

std::string PackageIndex::help_for_missing(const std::string& package, const Environment& environment) const {
  std::string help = did_you_mean(package, packages(environment));
  if (!help.empty() || !is_package_name(package)) {
    return help;
  }
  return variable(environment, kSearchPathVariable).empty()
             ? "AMENT_PREFIX_PATH is not set; source the setup file of the workspace that has the package"
             : "packages are searched in AMENT_PREFIX_PATH; source the setup file of the workspace that has the "
               "package";
}

std::string PackageIndex::share(const std::string& package, const Environment& environment) {
  return fmt::format("{}/share/{}", prefix(package, environment), package);
}

std::string PackageIndex::executable(const std::string& executable, const std::string& package,
                                     const Environment& environment) {
  const std::string found_at = prefix(package, environment);
  const std::string libexec = fmt::format("{}/lib/{}", found_at, package);
  std::error_code error;
  if (!fs::exists(libexec, error)) {
    throw std::runtime_error(fmt::format("package '{}' found at '{}', but libexec directory '{}' does not exist",
                                         package, found_at, libexec));
  }
  // As in ROS 2, a name with a slash is a path, not searched in the package.
  std::string path = executable.find('/') == std::string::npos ? fmt::format("{}/{}", libexec, executable) : executable;
  if (executable.empty() || !is_program(path)) {
    throw std::runtime_error(fmt::format(
        "executable '{}' not found on the libexec directory '{}'{}", executable, libexec,
        !executable.empty() && fs::is_regular_file(path, error) ? fmt::format(": '{}' is not executable", path) : ""));
  }
  return path;
}

std::vector<std::string> PackageIndex::packages(const Environment& environment) const {
  std::set<std::string> names;
  for (const std::string& candidate : search_path(environment, own_prefix_)) {
    for (std::string& name : file_names(fmt::format("{}/{}", candidate, kPackageMarkers))) {
      names.insert(std::move(name));
    }
  }
  return {names.begin(), names.end()};
}

std::vector<std::string> PackageIndex::executables(const std::string& package, const Environment& environment) {
  const std::string libexec = fmt::format("{}/lib/{}", prefix(package, environment), package);
  std::vector<std::string> names;
  for (std::string& name : file_names(libexec)) {
    if (is_program(fmt::format("{}/{}", libexec, name))) {
      names.push_back(std::move(name));
    }
  }
  std::sort(names.begin(), names.end());
  return names;
}

std::string PackageIndex::find_on_path(const std::string& name, const Environment& environment) {
  if (name.empty()) {
    return {};
  }
  if (name.find('/') != std::string::npos) {
    return is_program(name) ? name : std::string();
  }
  const std::string path = variable(environment, "PATH");
  if (path.empty()) {
    return {};
  }
  for (const std::string& directory : split_path(path)) {
    std::string candidate = directory.empty() ? name : fmt::format("{}/{}", directory, name);
    if (is_program(candidate)) {
      return candidate;
    }
  }
  return {};
}

}  // namespace launch
