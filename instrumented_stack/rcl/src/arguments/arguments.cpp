// SPDX-License-Identifier: Apache-2.0
#include "rcl/arguments.h"

#include <algorithm>
#include <cctype>
#include <cstring>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "arguments/arguments_impl.hpp"
#include "rcl/error_handling.h"
#include "rcutils/logging.h"

namespace {

using rcl::wrong;

using Impl = rcl_arguments_impl_s;

std::string quoted(std::string_view flag, std::string_view value) {
  return std::string("'").append(flag).append(" ").append(value).append("'");
}

int parse_level(std::string_view flag, std::string_view text, std::string_view level) {
  int severity = RCUTILS_LOG_SEVERITY_UNSET;
  if (rcutils_logging_severity_level_from_string(std::string(level).c_str(), rcutils_get_default_allocator(),
                                                 &severity) != RCUTILS_RET_OK) {
    wrong(quoted(flag, text) + ": '" + std::string(level) +
          "' is no log level; use debug, info, warn, error, fatal or unset");
  }
  return severity;
}

void remap(Impl& impl, std::string_view flag, std::string_view value) {
  try {
    impl.remap_rules.push_back(rcl::parse_remap_rule(value));
  } catch (const std::invalid_argument& error) {
    wrong(quoted(flag, value) + " is no remap rule: " + error.what());
  }
}

bool is_node_name(std::string_view text) {
  return !text.empty() &&
         std::all_of(text.begin(), text.end(), [](unsigned char c) { return std::isalnum(c) != 0 || c == '_'; });
}

void parameter(Impl& impl, std::string_view flag, std::string_view value) {
  const size_t arrow = value.find(":=");
  if (arrow == std::string_view::npos) {
    wrong(quoted(flag, value) + " is no parameter: expected NAME:=VALUE");
  }
  std::string_view name = value.substr(0, arrow);
  std::string_view node = "/**";
  if (const size_t colon = name.find(':'); colon != std::string_view::npos) {
    node = name.substr(0, colon);
    name.remove_prefix(colon + 1);
    if (!is_node_name(node)) {
      wrong(quoted(flag, value) + " is no parameter: '" + std::string(node) + "' is no valid node name");
    }
  }
  if (name.empty() || name.front() == '.' || name.back() == '.') {
    wrong(quoted(flag, value) + " is no parameter: '" + std::string(name) + "' is no valid parameter name");
  }
  try {
    impl.parameters.set_from_text(node, name, value.substr(arrow + 2));
  } catch (const std::invalid_argument& error) {
    wrong(quoted(flag, value) + " is no parameter: " + error.what());
  }
}

void parameter_file(Impl& impl, std::string_view flag, std::string_view value) {
  try {
    impl.parameters.load_file(std::string(value));
    impl.parameter_files.emplace_back(value);
  } catch (const std::invalid_argument& error) {
    wrong(quoted(flag, value) + ": " + error.what());
  }
}

void enclave(Impl& impl, std::string_view flag, std::string_view value) {
  if (!value.starts_with('/')) {
    wrong(quoted(flag, value) + ": an enclave must begin with a '/'");
  }
  impl.enclave = value;
}

void log_level(Impl& impl, std::string_view flag, std::string_view value) {
  const size_t arrow = value.find(":=");
  if (arrow == std::string_view::npos) {
    impl.default_log_level = parse_level(flag, value, value);
  } else if (arrow == 0) {
    wrong(quoted(flag, value) + ": no logger name stands before ':='");
  } else {
    impl.logger_levels.emplace_back(value.substr(0, arrow), parse_level(flag, value, value.substr(arrow + 2)));
  }
}

void log_config_file(Impl& impl, std::string_view, std::string_view value) {
  impl.log_config_file = value;
}

void log_file_name(Impl& impl, std::string_view, std::string_view value) {
  impl.log_file_name = value;
}

struct ValueFlag {
  std::string_view long_name;
  std::string_view short_name;  // empty: none
  const char* value;            // what must follow; used in the error message
  void (*apply)(Impl& impl, std::string_view flag, std::string_view value);
};

constexpr ValueFlag kValueFlags[] = {
    {RCL_REMAP_FLAG, RCL_SHORT_REMAP_FLAG, "a rule FROM:=TO", remap},
    {RCL_PARAM_FLAG, RCL_SHORT_PARAM_FLAG, "NAME:=VALUE", parameter},
    {RCL_PARAM_FILE_FLAG, "", "a file name", parameter_file},
    {RCL_ENCLAVE_FLAG, RCL_SHORT_ENCLAVE_FLAG, "an enclave", enclave},
    {RCL_LOG_LEVEL_FLAG, "", "a level or LOGGER:=LEVEL", log_level},
    {RCL_EXTERNAL_LOG_CONFIG_FLAG, "", "a file name", log_config_file},
    {RCL_LOG_FILE_NAME_FLAG, "", "a name", log_file_name},
};

struct Switch {
  std::string_view suffix;
  bool Impl::*target;
};

constexpr Switch kSwitches[] = {
    {RCL_LOG_STDOUT_FLAG_SUFFIX, &Impl::stdout_logs},
    {RCL_LOG_ROSOUT_FLAG_SUFFIX, &Impl::rosout_logs},
    {RCL_LOG_EXT_LIB_FLAG_SUFFIX, &Impl::external_logs},
};

// Parses `--enable-rosout-logs` and similar flags.
bool parse_switch(Impl& impl, std::string_view argument) {
  for (const auto& [prefix, value] : {std::pair<std::string_view, bool>{"--enable-", true}, {"--disable-", false}}) {
    if (!argument.starts_with(prefix)) {
      continue;
    }
    for (const Switch& known : kSwitches) {
      if (argument.substr(prefix.size()) == known.suffix) {
        impl.*known.target = value;
        return true;
      }
    }
  }
  return false;
}

// Handles argv[i], and moves `i` to the last argument that belongs to it. Returns false for an unknown flag.
bool parse_ros_argument(Impl& impl, int argc, const char* const* argv, int& i) {
  const std::string_view argument = argv[i];
  if (parse_switch(impl, argument)) {
    return true;
  }
  for (const ValueFlag& flag : kValueFlags) {
    if (argument != flag.long_name && (flag.short_name.empty() || argument != flag.short_name)) {
      continue;
    }
    if (i + 1 >= argc) {
      wrong("'" + std::string(argument) + "' is the last argument, but " + flag.value + " must follow it");
    }
    flag.apply(impl, argument, argv[++i]);
    return true;
  }
  return false;
}

bool parse_deprecated_rule(Impl& impl, const char* argument) {
  try {
    impl.remap_rules.push_back(rcl::parse_remap_rule(argument));
  } catch (const std::invalid_argument&) {
    return false;
  }
  rcutils_log(nullptr, RCUTILS_LOG_SEVERITY_WARN, "rcl",
              "remap rule '%s' stands outside --ros-args, which is deprecated: write '--ros-args -r %s'", argument,
              argument);
  return true;
}

void parse(Impl& impl, int argc, const char* const* argv) {
  bool in_ros_section = false;
  for (int i = 0; i < argc; ++i) {
    if (std::strcmp(argv[i], RCL_ROS_ARGS_FLAG) == 0) {
      in_ros_section = true;
    } else if (!in_ros_section) {
      if (!parse_deprecated_rule(impl, argv[i])) {
        impl.unparsed.push_back(i);
      }
    } else if (std::strcmp(argv[i], RCL_ROS_ARGS_EXPLICIT_END_TOKEN) == 0) {
      in_ros_section = false;
    } else if (!parse_ros_argument(impl, argc, argv, i)) {
      impl.unparsed_ros.push_back(i);
    }
  }
}

rcl_ret_t copy_indices(const std::vector<int>& indices, const rcl_allocator_t& allocator, int** output) {
  *output = nullptr;
  if (indices.empty()) {
    return RCL_RET_OK;
  }
  *output = static_cast<int*>(allocator.allocate(indices.size() * sizeof(int), allocator.state));
  if (*output == nullptr) {
    RCL_SET_ERROR_MSG("out of memory for arguments");
    return RCL_RET_BAD_ALLOC;
  }
  std::copy(indices.begin(), indices.end(), *output);
  return RCL_RET_OK;
}

}  // namespace

rcl_arguments_t rcl_get_zero_initialized_arguments(void) {
  return {};
}

rcl_ret_t rcl_parse_arguments(int argc, const char* const* argv, rcl_allocator_t, rcl_arguments_t* args_output) try {
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(args_output, RCL_RET_INVALID_ARGUMENT);
  if (argc < 0 || (argc > 0 && argv == nullptr)) {
    RCL_SET_ERROR_MSG("the number of arguments is negative, or there are none");
    return RCL_RET_INVALID_ARGUMENT;
  }
  if (args_output->impl != nullptr) {
    RCL_SET_ERROR_MSG("arguments are parsed already");
    return RCL_RET_INVALID_ARGUMENT;
  }
  auto impl = std::make_unique<Impl>();
  parse(*impl, argc, argv);
  args_output->impl = impl.release();
  return RCL_RET_OK;
} catch (const std::invalid_argument& error) {
  RCL_SET_ERROR_MSG(error.what());
  return RCL_RET_INVALID_ROS_ARGS;
}

int rcl_arguments_get_count_unparsed(const rcl_arguments_t* args) {
  return args == nullptr || args->impl == nullptr ? -1 : static_cast<int>(args->impl->unparsed.size());
}

rcl_ret_t rcl_arguments_get_unparsed(const rcl_arguments_t* args, rcl_allocator_t allocator,
                                     int** output_unparsed_indices) {
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(args, RCL_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(args->impl, RCL_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(output_unparsed_indices, RCL_RET_INVALID_ARGUMENT);
  return copy_indices(args->impl->unparsed, allocator, output_unparsed_indices);
}

int rcl_arguments_get_count_unparsed_ros(const rcl_arguments_t* args) {
  return args == nullptr || args->impl == nullptr ? -1 : static_cast<int>(args->impl->unparsed_ros.size());
}

rcl_ret_t rcl_arguments_get_unparsed_ros(const rcl_arguments_t* args, rcl_allocator_t allocator,
                                         int** output_unparsed_ros_indices) {
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(args, RCL_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(args->impl, RCL_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(output_unparsed_ros_indices, RCL_RET_INVALID_ARGUMENT);
  return copy_indices(args->impl->unparsed_ros, allocator, output_unparsed_ros_indices);
}

rcl_ret_t rcl_remove_ros_arguments(const char* const* argv, const rcl_arguments_t* args, rcl_allocator_t allocator,
                                   int* nonros_argc, const char*** nonros_argv) {
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(args, RCL_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(args->impl, RCL_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(nonros_argc, RCL_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(nonros_argv, RCL_RET_INVALID_ARGUMENT);
  const std::vector<int>& indices = args->impl->unparsed;
  *nonros_argc = static_cast<int>(indices.size());
  *nonros_argv = nullptr;
  if (indices.empty()) {
    return RCL_RET_OK;
  }
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(argv, RCL_RET_INVALID_ARGUMENT);
  // Ends with a null, like argv.
  auto** output =
      static_cast<const char**>(allocator.zero_allocate(indices.size() + 1, sizeof(const char*), allocator.state));
  if (output == nullptr) {
    RCL_SET_ERROR_MSG("out of memory for arguments");
    return RCL_RET_BAD_ALLOC;
  }
  std::transform(indices.begin(), indices.end(), output, [&](int index) { return argv[index]; });
  *nonros_argv = output;
  return RCL_RET_OK;
}

rcl_ret_t rcl_arguments_copy(const rcl_arguments_t* args, rcl_arguments_t* args_out) {
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(args, RCL_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(args_out, RCL_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(args->impl, RCL_RET_INVALID_ARGUMENT);
  if (args_out->impl != nullptr) {
    RCL_SET_ERROR_MSG("arguments to copy to are parsed already");
    return RCL_RET_INVALID_ARGUMENT;
  }
  args_out->impl = new rcl_arguments_impl_s(*args->impl);
  return RCL_RET_OK;
}

rcl_ret_t rcl_arguments_fini(rcl_arguments_t* args) {
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(args, RCL_RET_INVALID_ARGUMENT);
  if (args->impl == nullptr) {
    RCL_SET_ERROR_MSG("arguments were never parsed");
    return RCL_RET_ERROR;
  }
  delete args->impl;
  args->impl = nullptr;
  return RCL_RET_OK;
}
