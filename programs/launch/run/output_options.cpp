// SPDX-License-Identifier: Apache-2.0
#include "programs/launch/run/output_options.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <filesystem>
#include <optional>
#include <stdexcept>

#include "base/terminal/terminal.hpp"

namespace launch {

namespace {

// Throws std::invalid_argument with a sentence.
std::optional<MessageFormat> message_format(const Environment& environment, const char* variable) {
  const auto found = environment.find(variable);
  if (found == environment.end() || found->second.empty()) {
    return std::nullopt;
  }
  try {
    return MessageFormat(found->second);
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(fmt::format("{}: {}", variable, error.what()));
  }
}

}  // namespace

OutputRouter::Options output_options(const CommandLine& command, const Environment& environment,
                                     const std::string& log_directory, EventLoop& loop) {
  OutputRouter::Options options;
  options.log_directory = log_directory;
  if (const auto name = environment.find("OVERRIDE_LAUNCH_LOG_FILE_NAME");
      name != environment.end() && !name->second.empty()) {
    options.log_name = std::filesystem::path(name->second).filename().string();
  }
  if (!command.log_file_name.empty()) {
    options.log_name = command.log_file_name + (command.log_file_name.ends_with(".log") ? "" : ".log");
  }
  options.screen_level = command.debug ? LogLevel::kDebug : LogLevel::kInfo;
  options.colour = shows_colour(STDOUT_FILENO);
  options.timestamps = command.timestamps;
  options.screen_format = message_format(environment, "OVERRIDE_LAUNCH_SCREEN_FORMAT");
  options.log_format = message_format(environment, "OVERRIDE_LAUNCH_LOG_FORMAT");
  options.rotation = {command.log_size, command.log_files};
  options.error_fd = STDERR_FILENO;
  options.journal = Journal::behind(STDOUT_FILENO, environment);
  options.loop = &loop;
  return options;
}

LogLimits log_limits(const CommandLine& command, const Environment& environment) {
  if (!command.keep_logs.empty()) {
    return parse_log_limits(command.keep_logs);
  }
  const auto variable = environment.find("OVERRIDE_LAUNCH_KEEP_LOGS");
  if (variable == environment.end() || variable->second.empty()) {
    return LogLimits();
  }
  try {
    return parse_log_limits(variable->second);
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(fmt::format("OVERRIDE_LAUNCH_KEEP_LOGS: {}", error.what()));
  }
}

}  // namespace launch
