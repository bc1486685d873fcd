// SPDX-License-Identifier: Apache-2.0
#include "launcher/ros/ros_program.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "base/diagnostics/diagnostic.hpp"
#include "base/environment/own_prefix.hpp"

namespace launch {

namespace {

namespace fs = std::filesystem;

constexpr const char* kPackage = "launch_companion";

// Those over DDS understand each other: what they write for topics, services and nodes is the same.
constexpr std::array<std::string_view, 6> kMiddlewaresOfDds = {"rmw_fastrtps_cpp",   "rmw_fastrtps_dynamic_cpp",
                                                               "rmw_cyclonedds_cpp", "rmw_connextdds",
                                                               "rmw_connext_cpp",    "rmw_gurumdds_cpp"};

std::string value_of(const std::string& variable, const Environment& environment) {
  const auto found = environment.find(variable);
  return found == environment.end() ? std::string() : found->second;
}

std::optional<fs::path> companion_prefix(const Environment& environment) {
  std::istringstream prefixes(value_of("AMENT_PREFIX_PATH", environment));
  std::error_code ignored;
  for (std::string prefix; std::getline(prefixes, prefix, ':');) {
    if (!prefix.empty() && fs::is_directory(fs::path(prefix) / "lib" / kPackage, ignored)) {
      return prefix;
    }
  }
  return std::nullopt;
}

std::string version_in(const fs::path& prefix) {
  std::ifstream file(prefix / "share" / kPackage / "version");
  std::string version;
  std::getline(file, version);
  return version.empty() ? "unknown" : version;
}

// Where its sources are. As packages of a system they come apart from `launch`.
std::string sources() {
  const std::string directory = own_prefix() + "/share/launch/" + kPackage;
  std::error_code ignored;
  return fs::exists(directory, ignored) ? directory : directory + ", which the package launch-companion brings";
}

}  // namespace

std::optional<std::string> companion_program(std::string_view name, const Environment& environment) {
  const auto prefix = companion_prefix(environment);
  return prefix ? std::optional((*prefix / "lib" / kPackage / name).string()) : std::nullopt;
}

std::string ros_program(std::string_view name, const Environment& environment) {
  if (const auto prefix = companion_prefix(environment)) {
    if (const std::string version = version_in(*prefix); version != LAUNCH_VERSION) {
      throw LaunchError(fmt::format("{} in {} is of version {}, this launch of {}", kPackage, prefix->string(), version,
                                    LAUNCH_VERSION),
                        {}, "build it again from " + sources());
    }
    return (*prefix / "lib" / kPackage / name).string();
  }
  const std::string middleware = value_of("RMW_IMPLEMENTATION", environment);
  if (!middleware.empty() &&
      std::find(kMiddlewaresOfDds.begin(), kMiddlewaresOfDds.end(), middleware) == kMiddlewaresOfDds.end()) {
    throw LaunchError(
        fmt::format("nodes on {} need {}, which is in no prefix of AMENT_PREFIX_PATH", middleware, kPackage), {},
        "build it in your workspace, from " + sources());
  }
  return own_library_file(name);
}

bool is_of_companion(std::string_view program) {
  return fs::path(program).parent_path().filename() == kPackage;
}

}  // namespace launch
