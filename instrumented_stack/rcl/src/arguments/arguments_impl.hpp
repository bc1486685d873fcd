// SPDX-License-Identifier: Apache-2.0
// The parsed command line.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "arguments/remap_rule.hpp"
#include "rcl/arguments.h"
#include "rcl/parameter_overrides.hpp"

struct rcl_arguments_impl_s {
  std::vector<int> unparsed;      // indices into argv
  std::vector<int> unparsed_ros;  // indices into argv, inside ROS sections
  std::vector<rcl::RemapRule> remap_rules;
  rcl::ParameterOverrides parameters;
  std::vector<std::string> parameter_files;
  std::optional<std::string> enclave;
  std::optional<int> default_log_level;
  std::vector<std::pair<std::string, int>> logger_levels;
  std::string log_config_file;
  std::string log_file_name;
  bool stdout_logs = true;
  bool rosout_logs = true;
  bool external_logs = true;
};
