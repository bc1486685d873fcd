// <log message="…"/>: prints a message.
#include <fmt/format.h>

#include "launcher/core/fields.hpp"
#include "launcher/core/launch_context.hpp"

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
  explicit Log(const Fields& fields)
      : Action(fields.where(), fields.condition()), message_(fields.text("message")), level_(fields.optional_text("level")) {}

 protected:
  void execute(LaunchContext& context) const override {
    context.message(level(context.scope()), "launch.user", message_.perform(context.scope()));
  }

 private:
  LogLevel level(Scope& scope) const {
    if (!level_) {
      return LogLevel::kInfo;
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
};

}  // namespace

ActionType log_action() {
  return {
      .tag = "log",
      .help = "Prints a message.",
      .attributes = {{"message", AttributeType::kText, true, "", "the text"},
                     {"level", AttributeType::kText, false, "info", "debug, info, warning, error or critical"}},
      .items = {},
      .make = [](const Fields& fields) { return std::make_shared<Log>(fields); },
  };
}

}  // namespace launch
