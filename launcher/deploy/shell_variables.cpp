// SPDX-License-Identifier: Apache-2.0
#include "launcher/deploy/shell_variables.hpp"

#include <algorithm>
#include <array>

namespace launch {
namespace {

constexpr std::array<std::string_view, 10> kSettings = {
    "ROS_", "RMW_", "RCUTILS_", "RCL_", "FASTRTPS_", "FASTDDS_", "CYCLONEDDS_", "ZENOH_", "LTTNG_", "OVERRIDE_LAUNCH_"};
constexpr std::array<std::string_view, 2> kPaths = {"AMENT_", "COLCON_"};
constexpr std::array<std::string_view, 2> kSettingNames = {"PYTHONUNBUFFERED", "LANG"};
constexpr std::array<std::string_view, 5> kPathNames = {"PATH", "LD_LIBRARY_PATH", "PYTHONPATH", "CMAKE_PREFIX_PATH",
                                                        "PKG_CONFIG_PATH"};

template <typename Prefixes, typename Names>
bool is_one_of(std::string_view name, const Prefixes& prefixes, const Names& names) {
  return std::any_of(prefixes.begin(), prefixes.end(), [&](auto prefix) { return name.starts_with(prefix); }) ||
         std::find(names.begin(), names.end(), name) != names.end();
}

}  // namespace

bool is_setting_variable(std::string_view name) {
  return is_one_of(name, kSettings, kSettingNames);
}

bool is_path_variable(std::string_view name) {
  return is_one_of(name, kPaths, kPathNames);
}

}  // namespace launch
