// SPDX-License-Identifier: Apache-2.0
// Copies of processes, on virtual time.
#include "launcher/run/user/scaling.hpp"

#include <fmt/ranges.h>

#include "tests/unit/run/launch_service_fixture.hpp"

namespace launch {
namespace {

using namespace std::chrono_literals;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class ScalingTest : public LaunchServiceTest {
 protected:
  // Calls each step one second after the one before, and ends the launch after all.
  void run_steps(const std::string& actions, std::vector<std::function<void(LaunchService&)>> steps) {
    on_service = [this, steps](LaunchService& service) {
      for (std::size_t i = 0; i < steps.size(); ++i) {
        timers_.push_back(loop_.after((i + 1) * 1s, [&service, step = steps[i]] { step(service); }));
      }
      timers_.push_back(loop_.after(60s, [&service] { service.steering().shutdown(); }));
    };
    exit_code_ = run(actions);
  }
  static SteeringOutcome scale(LaunchService& service, const std::string& name, std::size_t count) {
    return service.scaling().scale(name, count);
  }

  int exit_code_ = -1;
  std::vector<EventLoop::SourcePtr> timers_;
};

TEST_F(ScalingTest, CopiesStartAndTheLastOnesEnd) {
  run_steps(R"xml(<executable name="w" cmd="w" scalable="true"/>)xml",
            {[](auto& service) { EXPECT_THAT(scale(service, "w", 3).done, ElementsAre("w_2", "w_3")); },
             [](auto& service) { EXPECT_THAT(scale(service, "w-1", 2).done, ElementsAre("w_3-3")); },
             [](auto& service) { EXPECT_THAT(scale(service, "w", 2).done, IsEmpty()); },
             [](auto& service) { EXPECT_THAT(scale(service, "w", 3).done, ElementsAre("w_3")); }});
  EXPECT_THAT(journal_, ElementsAre("start w-1", "start w_2-2", "start w_3-3", "exit w_3-3", "start w_3-4", "exit w-1",
                                    "exit w_2-2", "exit w_3-4"));
  EXPECT_EQ(runner_.spawned().at(1).spec.environment.at("LAUNCH_INSTANCE"), "2");
  EXPECT_EQ(exit_code_, 0);
}

TEST_F(ScalingTest, WhatIsNotDeclaredScalableIsRefused) {
  run_steps(R"xml(<executable name="a" cmd="a"/><executable name="w" cmd="w" scalable="true"/>
                  <executable name="t" cmd="t"/><executable name="t" cmd="t"/>)xml",
            {[](auto& service) {
               const SteeringOutcome outcome = scale(service, "a", 2);
               EXPECT_EQ(outcome.error, "'a' is not declared scalable (/test/system.launch.xml:2:2)");
               EXPECT_EQ(outcome.help, "write scalable=\"true\" there if several of it can run side by side");
             },
             [](auto& service) {
               EXPECT_EQ(scale(service, "ww", 2).error, "no process is named 'ww'");
               EXPECT_EQ(scale(service, "t", 2).error, "2 processes are named 't'");
               scale(service, "w", 2);
               EXPECT_EQ(scale(service, "w_2", 2).error, "'w_2' is a copy itself");
             }});
}

TEST_F(ScalingTest, ANodeGetsAnotherNameWithItsParameters) {
  run_steps(
      R"xml(<node exec="n" name="talker" namespace="/left" scalable="true"><param name="rate" value="1"/></node>)xml",
      {[](auto& service) { scale(service, "/left/talker", 2); }});
  const ProcessSpec& copy = runner_.spawned().at(1).spec;
  EXPECT_THAT(fmt::format("{}", fmt::join(copy.argv, " ")), HasSubstr("-r __node:=talker_2 "));
  EXPECT_THAT(copy.other_names, ElementsAre("talker_2", "/left/talker_2"));
  EXPECT_THAT(copy.files.at(0).content, HasSubstr("/left/talker_2:\n"));
}

TEST_F(ScalingTest, CopiesFollowAReload) {
  const auto load = [this](const std::string& text) {
    return [this, text] {
      return parse_launch_description(
          std::make_shared<SourceFile>("/test/system.launch.xml", "<launch>\n" + text + "\n</launch>"), registry_);
    };
  };
  run_steps(R"xml(<executable name="w" cmd="w 1" scalable="true"/><executable name="z" cmd="z"/>)xml",
            {[](auto& service) { scale(service, "w", 2); },
             [load](auto& service) {
               service.reloads().use(
                   load(R"xml(<executable name="w" cmd="w 2" scalable="true"/><executable name="z" cmd="z"/>)xml"));
               service.reloads().ask({});
             },
             [load](auto& service) {
               service.reloads().use(load(R"xml(<executable name="z" cmd="z"/>)xml"));
               service.reloads().ask({});
             }});
  std::vector<std::string> commands;
  for (const FakeProcessRunner::Spawned& spawned : runner_.spawned()) {
    commands.push_back(fmt::format("{}", fmt::join(spawned.spec.argv, " ")));
  }
  EXPECT_THAT(commands, testing::UnorderedElementsAre("w 1", "z", "w 1", "w 2", "w 2"));
  EXPECT_EQ(runner_.unreaped(), 0U);
}

}  // namespace
}  // namespace launch
