// SPDX-License-Identifier: Apache-2.0
#include "tests/unit/actions/launch_text.hpp"

#include "actions/builtin_actions.hpp"

namespace test_support {

Planned plan_text(const std::string& text, const PlanOptions& options) {
  static const launch::Registry registry = launch::builtin_actions();
  Planned planned;
  launch::LaunchContext context(registry, options.environment, "",
                                [&](launch::LogLevel, std::string_view logger, std::string_view message) {
                                  planned.messages.push_back("[" + std::string(logger) + "] " + std::string(message));
                                });
  for (const auto& [name, value] : options.arguments) {
    context.scope().configurations.insert_or_assign(name, value);
  }
  try {
    const char* const path = text.starts_with('<') ? "/test/system.launch.xml" : "/test/system.launch.yaml";
    const auto description =
        launch::parse_launch_description(std::make_shared<launch::SourceFile>(path, text), registry);
    planned.plan = launch::plan_launch(context, *description);
  } catch (const launch::LaunchError& error) {
    planned.error = error.what();
  }
  return planned;
}

Planned plan_actions(const std::string& xml, const PlanOptions& options) {
  return plan_text("<launch>\n" + xml + "\n</launch>\n", options);
}

std::string run_error(const std::string& xml) {
  const launch::Registry registry = launch::builtin_actions();
  launch::LaunchContext context(registry, {{"PATH", "/usr/bin:/bin"}}, "", [](auto...) {});
  try {
    const auto file =
        std::make_shared<launch::SourceFile>("/test/system.launch.xml", "<launch>\n" + xml + "\n</launch>\n");
    context.visit(*launch::parse_launch_description(file, registry));
  } catch (const launch::LaunchError& error) {
    return error.what();
  }
  return {};
}

}  // namespace test_support
