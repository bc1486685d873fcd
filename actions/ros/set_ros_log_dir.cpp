// SPDX-License-Identifier: Apache-2.0
// <set_ros_log_dir new_log_dir="…"/>: where later nodes write their log files.
#include <filesystem>

#include "base/environment/home_directory.hpp"
#include "launcher/language/fields.hpp"
#include "launcher/visit/launch_context.hpp"

namespace launch {

namespace {

class SetRosLogDir : public Action {
 public:
  explicit SetRosLogDir(const Fields& fields)
      : Action(fields.where(), fields.condition()), directory_(fields.text("new_log_dir")) {}

 protected:
  void execute(LaunchContext& context) const override {
    Scope& scope = context.scope();
    const auto directory = std::filesystem::path(ros_log_directory(scope.environment)) / directory_.perform(scope);
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
