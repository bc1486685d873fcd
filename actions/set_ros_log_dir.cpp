// SPDX-License-Identifier: Apache-2.0
// <set_ros_log_dir new_log_dir="…"/>: where later nodes write their log files.
#include <filesystem>

#include "launcher/language/fields.hpp"
#include "launcher/visit/launch_context.hpp"

namespace launch {

namespace {

// Where nodes write when nothing is set: rcl_logging's rule.
std::filesystem::path current_log_directory(const Environment& environment) {
  const auto value = [&](const char* name) {
    const auto found = environment.find(name);
    return found == environment.end() ? std::string() : found->second;
  };
  if (const std::string directory = value("ROS_LOG_DIR"); !directory.empty()) {
    return directory;
  }
  const std::string home = value("ROS_HOME");
  return home.empty() ? std::filesystem::path(value("HOME")) / ".ros" / "log" : std::filesystem::path(home) / "log";
}

class SetRosLogDir : public Action {
 public:
  explicit SetRosLogDir(const Fields& fields)
      : Action(fields.where(), fields.condition()), directory_(fields.text("new_log_dir")) {}

 protected:
  void execute(LaunchContext& context) const override {
    Scope& scope = context.scope();
    const auto directory = current_log_directory(scope.environment) / directory_.perform(scope);
    scope.environment.insert_or_assign("ROS_LOG_DIR", directory.string());
  }

 private:
  Template directory_;
};

}  // namespace

ActionType set_ros_log_dir_action() {
  return {
      .tag = "set_ros_log_dir",
      .help = "Sets where later nodes write their log files (ROS_LOG_DIR).",
      .attributes = {{"new_log_dir", AttributeType::kText, true, "", "the directory; relative to the current one"}},
      .items = {},
      .make = [](const Fields& fields) { return std::make_shared<SetRosLogDir>(fields); },
  };
}

}  // namespace launch
