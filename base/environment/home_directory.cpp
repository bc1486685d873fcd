// SPDX-License-Identifier: Apache-2.0
#include "base/environment/home_directory.hpp"

#include <pwd.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <vector>

namespace launch {
namespace {

// The size to try first. An entry with a long list of members or a network directory may need more: getpwuid_r then
// returns ERANGE.
constexpr std::size_t kUsualEntry = 1024;  // bytes
constexpr std::size_t kLongestEntry = 1024 * 1024;

std::string from_password_database() {
  for (std::vector<char> text(kUsualEntry); text.size() <= kLongestEntry; text.resize(text.size() * 2)) {
    passwd entry{};
    passwd* found = nullptr;
    const int error = ::getpwuid_r(::getuid(), &entry, text.data(), text.size(), &found);
    if (error == ERANGE) {
      continue;
    }
    return found == nullptr || *found->pw_dir == '\0' ? "/" : found->pw_dir;
  }
  return "/";
}

std::string value_of(const std::map<std::string, std::string>& environment, const char* name) {
  const auto found = environment.find(name);
  return found == environment.end() ? std::string() : found->second;
}

}  // namespace

std::string home_directory(const std::map<std::string, std::string>& environment) {
  std::string home = value_of(environment, "HOME");
  return home.empty() ? from_password_database() : home;
}

std::string home_directory() {
  const char* const home = std::getenv("HOME");
  return home == nullptr || *home == '\0' ? from_password_database() : home;
}

std::string expand_home(const std::string& path, const std::map<std::string, std::string>& environment) {
  const bool in_home = path == "~" || path.starts_with("~/");
  return in_home ? home_directory(environment) + path.substr(1) : path;
}

std::string ros_home(const std::map<std::string, std::string>& environment) {
  const std::string given = value_of(environment, "ROS_HOME");
  return expand_home(given.empty() ? "~/.ros" : given, environment);
}

std::string ros_log_directory(const std::map<std::string, std::string>& environment) {
  const std::string given = value_of(environment, "ROS_LOG_DIR");
  return given.empty() ? ros_home(environment) + "/log" : expand_home(given, environment);
}

}  // namespace launch
