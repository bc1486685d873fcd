// SPDX-License-Identifier: Apache-2.0
// <log message="…" level="…"/>, <log_info message="…"/> and the other levels: print a message.
#include <fmt/format.h>

#include <map>

#include "actions/row_action.hpp"

namespace launch {

namespace {

const std::vector<std::pair<std::string, LogLevel>>& level_names() {
  static const std::vector<std::pair<std::string, LogLevel>> names = {{"debug", LogLevel::kDebug},
                                                                      {"info", LogLevel::kInfo},
                                                                      {"warning", LogLevel::kWarning},
                                                                      {"error", LogLevel::kError},
                                                                      {"critical", LogLevel::kCritical}};
  return names;
}

struct LogEntry {
  std::string text = {};
  LogLevel level = LogLevel::kInfo;
};

void perform_level(const Fields& fields, Scope& scope, LogEntry& message) {
  std::string name = fields.text("level").perform(scope);
  for (char& character : name) {
    character = static_cast<char>(std::tolower(static_cast<unsigned char>(character)));
  }
  std::vector<std::string> known;
  for (const auto& [known_name, known_level] : level_names()) {
    if (name == known_name) {
      message.level = known_level;
      return;
    }
    known.push_back(known_name);
  }
  // Names of Python's logging that ROS 2 knows besides. NOTSET is below every level that is shown.
  static const std::map<std::string, LogLevel> others = {
      {"warn", LogLevel::kWarning}, {"fatal", LogLevel::kCritical}, {"notset", LogLevel::kDebug}};
  if (const auto other = others.find(name); other != others.end()) {
    message.level = other->second;
    return;
  }
  throw LaunchError(fmt::format("invalid log level '{}', expected debug, info, warning, error or critical", name),
                    fields.text("level").where(), did_you_mean(name, known));
}

// Without a level of its own the action has an attribute for it.
ActionType log_of(std::string tag, std::string help, std::optional<LogLevel> own) {
  std::vector<Setting<LogEntry>> rows = {
      {.attribute = {"message", AttributeType::kText, true, "", "the text"}, .place = place_of(&LogEntry::text)}};
  if (!own) {
    rows.push_back(
        {.attribute = {"level", AttributeType::kText, false, "info", "debug, info, warning, error or critical"},
         .perform = perform_level});
  }
  return action_of<LogEntry>({.tag = std::move(tag), .help = std::move(help)}, std::move(rows),
                             [own](const Fields&, LaunchContext& context, LogEntry& message) {
                               context.message(own.value_or(message.level), "launch.user", message.text);
                               context.requests().logs.push_back(std::move(message.text));
                             });
}

}  // namespace

ActionType log_debug_action() {
  return log_of("log_debug", "Prints a message of level debug.", LogLevel::kDebug);
}
ActionType log_info_action() {
  return log_of("log_info", "Prints a message of level info.", LogLevel::kInfo);
}
ActionType log_warning_action() {
  return log_of("log_warning", "Prints a message of level warning.", LogLevel::kWarning);
}
ActionType log_error_action() {
  return log_of("log_error", "Prints a message of level error.", LogLevel::kError);
}

ActionType log_action() {
  return log_of("log", "Prints a message.", std::nullopt);
}

}  // namespace launch
