// SPDX-License-Identifier: Apache-2.0
#include "launcher/run/user/steering.hpp"

#include "tests/unit/run/launch_service_fixture.hpp"

namespace launch {
namespace {

using namespace std::chrono_literals;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using Request = Steering::Request;

class SteeringTest : public LaunchServiceTest {
 protected:
  // Lets a user do something at a moment of the next run.
  void at(Duration moment, std::function<void(Steering&)> what) {
    on_service = [this, before = std::move(on_service), moment, what = std::move(what)](LaunchService& service) {
      if (before) {
        before(service);
      }
      timers_.push_back(loop_.after(moment, [&service, what] { what(service.steering()); }));
    };
  }

  std::vector<EventLoop::SourcePtr> timers_;
};

std::vector<std::string> names(const std::vector<SteeredProcess>& processes) {
  std::vector<std::string> all;
  for (const SteeredProcess& process : processes) {
    all.push_back(process.name);
  }
  return all;
}

TEST_F(SteeringTest, PatternsAreForLabelsAndNames) {
  at(1s, [](Steering& steering) {
    SteeringOutcome outcome;
    EXPECT_THAT(names(steering.find({}, outcome)), ElementsAre("talker-1", "listener-2", "talker-3"));
    EXPECT_THAT(names(steering.find({{"talker"}}, outcome)), ElementsAre("talker-1", "talker-3"));
    EXPECT_THAT(names(steering.find({{"*-3", "list*"}}, outcome)), ElementsAre("listener-2", "talker-3"));
    EXPECT_EQ(outcome.error, "");
    EXPECT_THAT(steering.find({{"talker", "lisener"}}, outcome), IsEmpty());
    EXPECT_EQ(outcome.error, "no process is named 'lisener'");
    EXPECT_EQ(outcome.help, "did you mean 'listener'?");
    steering.shutdown();
  });
  EXPECT_EQ(run(R"xml(<executable cmd="talker"/><executable cmd="listener"/><executable cmd="talker"/>)xml"), 0);
}

TEST_F(SteeringTest, ANameWithCharactersOfAPatternMeansItsProcessAlone) {
  at(1s, [](Steering& steering) {
    SteeringOutcome outcome;
    EXPECT_THAT(names(steering.find({{"cam[0]-1"}}, outcome)), ElementsAre("cam[0]-1"));
    EXPECT_THAT(names(steering.find({{"cam[0]"}}, outcome)), ElementsAre("cam[0]-1"));
    EXPECT_THAT(names(steering.find({{"cam[0]*"}}, outcome)), ElementsAre("cam0-2"));
    steering.shutdown();
  });
  run(R"xml(<executable name="cam[0]" cmd="a"/><executable name="cam0" cmd="b"/>)xml");
}

TEST_F(SteeringTest, WhatWasStoppedCanStartAgainAndTheLaunchWaitsForThat) {
  at(1s, [](Steering& steering) { EXPECT_THAT(steering.ask(Request::kStop, {{"a"}}).done, ElementsAre("a-1")); });
  at(100s, [](Steering& steering) {
    EXPECT_THAT(steering.ask(Request::kStop, {{"a"}}).refused, ElementsAre("a-1 does not run"));
    EXPECT_THAT(steering.ask(Request::kStart, {{"a"}}).done, ElementsAre("a-1"));
    EXPECT_THAT(steering.ask(Request::kStart, {{"a"}}).refused, ElementsAre("a-1 runs already"));
  });
  at(200s, [](Steering& steering) { steering.shutdown(); });
  EXPECT_EQ(run(R"xml(<executable cmd="a" respawn="true"/>)xml"), 0);
  EXPECT_THAT(journal_, ElementsAre("start a-1", "exit a-1", "start a-1", "exit a-1"));
  EXPECT_EQ(loop_.now(), 200s);
}

TEST_F(SteeringTest, TheLaunchEndsWhenAProcessThatWasStartedAgainEnds) {
  runner_.script("a", {{}, {.exits_after = 5s}});
  at(1s, [](Steering& steering) { steering.ask(Request::kStop, {{"a"}}); });
  at(2s, [](Steering& steering) { steering.ask(Request::kStart, {{"a"}}); });
  EXPECT_EQ(run(R"xml(<executable cmd="a"/>)xml"), 0);
  EXPECT_EQ(loop_.now(), 7s);
}

TEST_F(SteeringTest, AProcessThatWaitsNeverStartsOnceItWasStopped) {
  runner_.script("a", {{.exits_after = 5s}});
  at(1s, [](Steering& steering) {
    const std::vector<SteeredProcess> all = steering.processes();
    ASSERT_EQ(all.size(), 2U);
    EXPECT_EQ(all[1].name, "b");
    EXPECT_TRUE(all[1].waits);
    EXPECT_THAT(to_string(all[1].origin), HasSubstr("system.launch.xml:2:"));
    EXPECT_THAT(steering.ask(Request::kStart, {{"b"}}).refused, ElementsAre("b waits for its start"));
    EXPECT_THAT(steering.ask(Request::kStop, {{"b"}}).dropped, ElementsAre("b"));
    EXPECT_TRUE(steering.processes()[1].skipped);
    EXPECT_THAT(steering.ask(Request::kStop, {{"b"}}).refused, ElementsAre("b has never been started"));
  });
  EXPECT_EQ(
      run(R"xml(<executable cmd="a"/><executable cmd="b"><depends_on process="a" condition="exited"/></executable>)xml"),
      0);
  EXPECT_THAT(journal_, ElementsAre("start a-1", "exit a-1"));
}

TEST_F(SteeringTest, NothingStartsWhileTheLaunchEnds) {
  runner_.default_script({.ignores = {SIGINT}});
  std::vector<std::string> ends;
  at(1s, [&](Steering& steering) {
    steering.observe_end([&](const std::string& reason) { ends.push_back(reason); });
    steering.shutdown();
    steering.shutdown();
    EXPECT_TRUE(steering.is_ending());
    EXPECT_EQ(steering.ask(Request::kRestart, {{"a"}}).error, "the launch is ending, nothing can restart any more");
    EXPECT_EQ(steering.ask(Request::kStart, {{"a"}}).error, "the launch is ending, nothing can start any more");
  });
  EXPECT_EQ(run(R"xml(<executable cmd="a"/>)xml"), 0);
  EXPECT_THAT(ends, ElementsAre("launch shutdown"));
  EXPECT_THAT(messages_, testing::Contains("[launch] ending the launch, by launch shutdown"));
}

TEST_F(SteeringTest, RestartsAreCountedAndTheLastEndIsKnown) {
  runner_.script("a", {{.exits_after = 1s, .exit_code = 3}, {.exits_after = 10s}});
  at(5s, [this](Steering& steering) {
    EXPECT_EQ(supervisor_.view(1).runs, 1);
    EXPECT_EQ(supervisor_.view(1).pid, -1);
    ASSERT_TRUE(supervisor_.view(1).last_exit);
    EXPECT_EQ(supervisor_.view(1).last_exit->code, 3);
    steering.ask(Request::kRestart, {{"a"}});
    EXPECT_EQ(supervisor_.view(1).runs, 2);
    EXPECT_GT(supervisor_.view(1).pid, 0);
  });
  at(7s, [this](Steering&) { EXPECT_EQ(supervisor_.view(1).running_for, 2s); });
  EXPECT_EQ(run(R"xml(<executable cmd="a"/><timer period="20.0"><log message="end"/></timer>)xml"), 3);
}

}  // namespace
}  // namespace launch
