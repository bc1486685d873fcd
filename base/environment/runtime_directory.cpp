// SPDX-License-Identifier: Apache-2.0
#include "base/environment/runtime_directory.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <filesystem>
#include <string_view>
#include <system_error>
#include <utility>

namespace launch {
namespace {

constexpr mode_t kOwnerOnly = 0700;

// The candidates, best first.
std::vector<std::string> paths(const Environment& environment) {
  std::vector<std::string> all;
  const auto runtime = environment.find("XDG_RUNTIME_DIR");
  struct stat status {};
  // sudo(8) may keep the variable of the user who has called it.
  if (runtime != environment.end() && runtime->second.starts_with('/') &&
      ::stat(runtime->second.c_str(), &status) == 0 && status.st_uid == ::geteuid()) {
    all.push_back(runtime->second + "/launch");
  }
  all.push_back(fmt::format("/tmp/launch-{}", ::geteuid()));
  return all;
}

// Sets errno if there is none.
UniqueFd open_of(uid_t owner, const std::string& path) {
  UniqueFd fd(::open(path.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC));
  struct stat status {};
  if (!fd || ::fstat(fd.get(), &status) != 0) {
    return {};
  }
  if (status.st_uid != owner || (status.st_mode & 0777 & ~kOwnerOnly) != 0) {
    errno = EPERM;
    return {};
  }
  return fd;
}

}  // namespace

std::string RuntimeDirectory::address(const std::string& name) const {
  return fmt::format("/proc/self/fd/{}/{}", fd.get(), name);
}

RuntimeDirectory RuntimeDirectory::make(const Environment& environment) {
  std::string failed;
  int error = 0;
  for (const std::string& path : paths(environment)) {
    UniqueFd fd;
    if (::mkdir(path.c_str(), kOwnerOnly) == 0 || errno == EEXIST) {
      fd = open_of(::geteuid(), path);
    }
    if (fd) {
      return {path, std::move(fd), ::geteuid()};
    }
    failed = path;
    error = errno;
  }
  throw std::system_error(error, std::system_category(), fmt::format("cannot use the directory '{}'", failed));
}

std::vector<RuntimeDirectory> RuntimeDirectory::find(const Environment& environment) {
  std::vector<RuntimeDirectory> found;
  for (const std::string& path : paths(environment)) {
    if (UniqueFd fd = open_of(::geteuid(), path)) {
      found.push_back({path, std::move(fd), ::geteuid()});
    }
  }
  return found;
}

std::vector<RuntimeDirectory> RuntimeDirectory::find_of_others() {
  std::vector<RuntimeDirectory> found;
  const auto add = [&found](const std::string& number, const std::string& directory) {
    uid_t user = 0;
    const auto end = std::from_chars(number.data(), number.data() + number.size(), user);
    if (end.ec != std::errc() || end.ptr != number.data() + number.size() || user == ::geteuid()) {
      return;
    }
    if (UniqueFd opened = open_of(user, directory)) {
      found.push_back({directory, std::move(opened), user});
    }
  };
  constexpr std::string_view kPrefix = "launch-";
  std::error_code unreadable;
  for (const auto& entry : std::filesystem::directory_iterator("/tmp", unreadable)) {
    if (const std::string name = entry.path().filename().string(); name.starts_with(kPrefix)) {
      add(name.substr(kPrefix.size()), entry.path().string());
    }
  }
  for (const auto& entry : std::filesystem::directory_iterator("/run/user", unreadable)) {
    add(entry.path().filename().string(), entry.path().string() + "/launch");
  }
  return found;
}

}  // namespace launch
