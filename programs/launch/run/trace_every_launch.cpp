// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <utility>

#include "launcher/visit/launch_context.hpp"
#include "programs/launch/run/run_command.hpp"

namespace launch {

namespace {

class UnlessTraced : public Action {
 public:
  UnlessTraced(SourceRange where, std::vector<ActionPtr> actions)
      : Action(std::move(where), Condition()), actions_(std::move(actions)) {}

 protected:
  void execute(LaunchContext& context) const override {
    if (context.requests().scopes.empty()) {
      context.visit(actions_);
    }
  }

 private:
  std::vector<ActionPtr> actions_;
};

// "01_ping_pong" of "/…/01_ping_pong.launch.xml", without characters that mean something in a path, a substitution or
// XML.
std::string session_name_of(const std::string& path) {
  std::string name = std::filesystem::path(path).filename().string();
  name.resize(std::min(name.find('.'), name.size()));
  std::replace_if(
      name.begin(), name.end(),
      [](unsigned char character) { return std::isalnum(character) == 0 && character != '-' && character != '_'; },
      '_');
  return name.empty() ? "launch" : name;
}

}  // namespace

std::shared_ptr<const LaunchDescription> with_trace(const LaunchDescription& description, const Registry& registry) {
  const std::string text =
      fmt::format("<launch><trace session-name=\"{}\" append-timestamp=\"true\"/></launch>",
                  description.file == nullptr ? "launch" : session_name_of(description.file->path()));
  const auto trace = parse_launch_description(std::make_shared<SourceFile>("--trace", text), registry);
  auto traced = std::make_shared<LaunchDescription>(description);
  traced->actions.push_back(std::make_shared<UnlessTraced>(trace->actions.front()->where(), trace->actions));
  return traced;
}

}  // namespace launch
