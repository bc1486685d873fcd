// SPDX-License-Identifier: Apache-2.0
// A launch on virtual time, with processes and scopes that follow scripts. It notes what happens.
#pragma once

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "actions/builtin_actions.hpp"
#include "launcher/language/fields.hpp"
#include "launcher/process/fake/fake_event_loop.hpp"
#include "launcher/process/fake/fake_process_runner.hpp"
#include "launcher/run/launch_service.hpp"
#include "tests/unit/run/fake_scope.hpp"

namespace launch {

class ScopeAction : public Action {
 public:
  ScopeAction(const Fields& fields, Diary& journal)
      : Action(fields.where(), fields.condition()),
        name_(fields.literal("name")),
        fails_(fields.literal("fails") == "true"),
        journal_(journal) {}

 protected:
  void execute(LaunchContext& context) const override {
    context.requests().scopes.push_back(std::make_unique<FakeScope>(name_, fails_, where(), journal_));
  }

 private:
  std::string name_;
  bool fails_;
  Diary& journal_;
};

class LaunchServiceTest : public testing::Test {
 protected:
  LaunchServiceTest() : registry_(builtin_actions()) {
    registry_.add({.tag = "scope",
                   .help = "",
                   .attributes = {{"name", AttributeType::kLiteral, true, "", ""},
                                  {"fails", AttributeType::kLiteral, false, "", ""}},
                   .items = {},
                   .make = [this](const Fields& fields) { return std::make_shared<ScopeAction>(fields, journal_); }});
    supervisor_.observe([this](const ProcessEvent& event) {
      if (std::holds_alternative<ProcessStarted>(event.what)) {
        journal_.push_back("start " + event.label);
      } else if (std::holds_alternative<ProcessExited>(event.what)) {
        journal_.push_back("exit " + event.label);
      }
    });
  }

  int run(const std::string& actions) {
    const auto file = std::make_shared<SourceFile>("/test/system.launch.xml", "<launch>\n" + actions + "\n</launch>");
    LaunchContext context(registry_, {{"PATH", "/bin"}}, "",
                          [this](LogLevel, std::string_view logger, std::string_view text) {
                            messages_.push_back(fmt::format("[{}] {}", logger, text));
                          });
    LaunchService service(context, loop_, supervisor_,
                          [this](const LaunchError& error) { errors_.emplace_back(error.what()); });
    if (client != nullptr) {
      service.use_ros_client(*client);
    }
    if (on_service) {
      on_service(service);
    }
    return service.run(*parse_launch_description(file, registry_));
  }

  RosClient* client = nullptr;                     // of the launch
  std::function<void(LaunchService&)> on_service;  // called before the launch runs
  Diary journal_;
  std::vector<std::string> messages_;
  std::vector<std::string> errors_;
  Registry registry_;
  FakeEventLoop loop_;
  FakeProcessRunner runner_{loop_};
  OutputRouter output_{[] {
    OutputRouter::Options options;
    options.screen_fd = -1;
    return options;
  }()};
  ProcessSupervisor supervisor_{loop_, runner_, output_};
};

}  // namespace launch
