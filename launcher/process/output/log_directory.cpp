// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <filesystem>
#include <system_error>
#include <utility>

#include "base/environment/home_directory.hpp"
#include "launcher/process/output/old_logs.hpp"
#include "launcher/process/output/output_router.hpp"

namespace launch {
namespace {

namespace fs = std::filesystem;

// YYYY-MM-DD-HH-MM-SS-ffffff-HOST-PID, local time.
std::string run_name() {
  const auto now = std::chrono::system_clock::now();
  const std::time_t seconds = std::chrono::system_clock::to_time_t(now);
  const auto since_epoch = std::chrono::duration_cast<std::chrono::microseconds>(now.time_since_epoch());
  tm local{};
  ::localtime_r(&seconds, &local);
  std::array<char, 32> date{};
  std::strftime(date.data(), date.size(), "%Y-%m-%d-%H-%M-%S", &local);
  std::array<char, 256> host{};
  ::gethostname(host.data(), host.size() - 1);
  return fmt::format("{}-{:06}-{}-{}", date.data(), since_epoch.count() % 1'000'000, host.data(), ::getpid());
}

// Replaces the link in one step, so that it is never missing. Returns a warning, or "".
std::string renew_latest(const fs::path& base, const std::string& name) {
  const fs::path latest = base / "latest";
  std::error_code error;
  const fs::file_status status = fs::symlink_status(latest, error);
  if (fs::exists(status) && !fs::is_symlink(status)) {
    return fmt::format("'{}' is not a symbolic link: it is left as it is", latest.string());
  }
  const fs::path fresh = base / fmt::format(".latest-{}", ::getpid());
  fs::remove(fresh, error);
  fs::create_directory_symlink(name, fresh, error);
  if (!error) {
    fs::rename(fresh, latest, error);
  }
  return error ? fmt::format("cannot update the link '{}': {}", latest.string(), error.message()) : std::string();
}

[[noreturn]] void fail(const fs::path& directory, const std::error_code& error) {
  throw std::system_error(error, fmt::format("cannot create the log directory '{}' (ROS_LOG_DIR may name another one)",
                                             directory.string()));
}

}  // namespace

std::string LogDirectory::choose(const std::map<std::string, std::string>& environment) {
  return (fs::absolute(ros_log_directory(environment)) / run_name()).string();
}

LogDirectory LogDirectory::create(const std::string& chosen) {
  const fs::path base = fs::path(chosen).parent_path();
  std::error_code error;
  fs::create_directories(base, error);
  if (error) {
    fail(base, error);
  }
  for (std::string name = fs::path(chosen).filename();; name = run_name()) {
    const fs::path directory = base / name;
    if (::mkdir(directory.c_str(), 0777) == 0) {
      UniqueFd running = mark_log_directory(directory.string());
      return {directory.string(), renew_latest(base, name), std::move(running)};
    }
    if (errno != EEXIST) {  // else another run began in the same microsecond
      fail(directory, {errno, std::system_category()});
    }
  }
}

}  // namespace launch
