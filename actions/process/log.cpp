// SPDX-License-Identifier: Apache-2.0
// <log message="…" level="…"/>, <log_info message="…"/> and the other levels: print a message.
#include <fmt/format.h>

#include "launcher/language/fields.hpp"
#include "launcher/visit/launch_context.hpp"

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

class Log : public Action {
 public:
  // `fallback` is the level when the tag doesn't take one or none is given.
  Log(const Fields& fields, LogLevel fallback)
      : Action(fields.where(), fields.condition()),
        message_(fields.text("message")),
        level_(fields.optional_text("level")),
        fallback_(fallback) {}

 protected:
  void execute(LaunchContext& context) const override {
    const std::string text = message_.perform(context.scope());
    context.message(level(context.scope()), "launch.user", text);
    context.requests().logs.push_back(text);
  }

 private:
  LogLevel level(Scope& scope) const {
    if (!level_) {
      return fallback_;
    }
    std::string name = level_->perform(scope);
    for (char& character : name) {
      character = static_cast<char>(std::tolower(static_cast<unsigned char>(character)));
    }
    std::vector<std::string> known;
    for (const auto& [known_name, known_level] : level_names()) {
      if (name == known_name) {
        return known_level;
      }
      known.push_back(known_name);
    }
    throw LaunchError(fmt::format("invalid log level '{}', expected debug, info, warning, error or critical", name),
                      level_->where(), did_you_mean(name, known));
  }

  Template message_;
  std::optional<Template> level_;
  LogLevel fallback_;
};

ActionType log_with_level(const std::string& level_name, LogLevel level) {
  return {
      .tag = "log_" + level_name,
      .help = fmt::format("Prints a message of level {}.", level_name),
      .attributes = {{"message", AttributeType::kText, true, "", "the text"}},
      .items = {},
      .make = [level](const Fields& fields) { return std::make_shared<Log>(fields, level); },
  };
}

}  // namespace

ActionType log_debug_action() {
  return log_with_level("debug", LogLevel::kDebug);
}
ActionType log_info_action() {
  return log_with_level("info", LogLevel::kInfo);
}
ActionType log_warning_action() {
  return log_with_level("warning", LogLevel::kWarning);
}
ActionType log_error_action() {
  return log_with_level("error", LogLevel::kError);
}

ActionType log_action() {
  return {
      .tag = "log",
      .help = "Prints a message.",
      .attributes = {{"message", AttributeType::kText, true, "", "the text"},
                     {"level", AttributeType::kText, false, "info", "debug, info, warning, error or critical"}},
      .items = {},
      .make = [](const Fields& fields) { return std::make_shared<Log>(fields, LogLevel::kInfo); },
  };
}

}  // namespace launch
