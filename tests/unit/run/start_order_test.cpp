// SPDX-License-Identifier: Apache-2.0
// depends_on: the conditions of processes, and what happens when a condition can't hold any more.
#include <signal.h>

#include "tests/unit/run/launch_service_fixture.hpp"

namespace launch {
namespace {

using namespace std::chrono_literals;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

using StartOrderTest = LaunchServiceTest;

TEST_F(StartOrderTest, ProcessesStartOnceThoseTheyWaitForHaveStarted) {
  runner_.default_script({.exits_after = 1s});
  EXPECT_EQ(run(R"xml(<executable cmd="c"><depends_on process="b"/></executable>
                   <executable cmd="b"><depends_on process="a"/></executable>
                   <executable cmd="a"/>)xml"),
            0);
  EXPECT_THAT(journal_, ElementsAre("start a-1", "start b-2", "start c-3", "exit a-1", "exit b-2", "exit c-3"));
  EXPECT_THAT(messages_, ElementsAre("[c] waits until 'b' has started", "[b] waits until 'a' has started"));
}

TEST_F(StartOrderTest, WaitsForAnExitWithTheCode) {
  runner_.script("calibrate", {{.exits_after = 2s}});
  runner_.script("drive", {{.exits_after = 1s}});
  EXPECT_EQ(run(R"xml(<executable cmd="drive"><depends_on process="calibrate" condition="exited"/></executable>
                   <executable cmd="calibrate"/>)xml"),
            0);
  EXPECT_THAT(journal_, ElementsAre("start calibrate-1", "exit calibrate-1", "start drive-2", "exit drive-2"));
  EXPECT_EQ(runner_.spawned().at(1).at, 2s);
}

TEST_F(StartOrderTest, WaitsForALineAndForAllConditions) {
  runner_.script("server", {{.exits_after = 9s, .output = {{.at = 3s, .text = "listening on 80\n"}}}});
  runner_.script("data", {{.exits_after = 4s}});
  runner_.script("client", {{.exits_after = 1s}});
  EXPECT_EQ(run(R"xml(<executable cmd="server"/><executable cmd="data"/>
                   <executable cmd="client">
                     <depends_on process="server" condition="output" pattern="listening on \\d+" stream="stdout"/>
                     <depends_on process="data" condition="exited" exit_code="any"/>
                   </executable>)xml"),
            0);
  EXPECT_EQ(runner_.spawned().at(2).at, 4s);
}

TEST_F(StartOrderTest, ARespawningProcessMayStillSucceed) {
  runner_.script("calibrate", {{.exits_after = 1s, .exit_code = 1}, {.exits_after = 1s}});
  runner_.script("drive", {{.exits_after = 1s}});
  EXPECT_EQ(run(R"xml(<executable cmd="drive"><depends_on process="calibrate" condition="exited"/></executable>
                   <executable cmd="calibrate" respawn="true" respawn_max_retries="1"/>)xml"),
            3);
  EXPECT_EQ(runner_.spawned().at(2).spec.name, "drive");
  EXPECT_EQ(runner_.spawned().at(2).at, 2s);
}

TEST_F(StartOrderTest, ShutsTheSystemDownWhenAConditionCannotHoldAnyMore) {
  runner_.script("calibrate", {{.exits_after = 2s, .exit_code = 3}});
  EXPECT_EQ(run(R"xml(<executable cmd="drive"><depends_on process="calibrate" condition="exited"/></executable>
<executable cmd="calibrate"/><executable cmd="other"/>)xml"),
            1);
  EXPECT_THAT(journal_, ElementsAre("start calibrate-1", "start other-2", "exit calibrate-1", "exit other-2"));
  EXPECT_THAT(errors_,
              ElementsAre("/test/system.launch.xml:2:26: error: 'drive' can't start: 'calibrate' has ended with exit "
                          "code 3\n"
                          "    2 | <executable cmd=\"drive\"><depends_on process=\"calibrate\" condition=\"exited\"/></"
                          "executable>\n"
                          "      |                          ^~~~~~~~~~\n"
                          "      = help: on_failure=\"start\" starts it all the same, on_failure=\"skip\" goes on "
                          "without it"));
}

TEST_F(StartOrderTest, StartsAllTheSameWhereAsked) {
  runner_.script("a", {{.spawn_error = ENOENT}});
  runner_.script("b", {{.exits_after = 1s}});
  EXPECT_EQ(run(R"xml(<executable cmd="a"/>
<executable cmd="b"><depends_on process="a" on_failure="start"/></executable>)xml"),
            3);
  EXPECT_THAT(journal_, ElementsAre("start b-2", "exit b-2"));
  EXPECT_EQ(messages_.at(0), "[b] waits until 'a' has started");
  EXPECT_EQ(messages_.at(1), "[b] starts although 'a' was not started (/test/system.launch.xml:3:22)");
}

TEST_F(StartOrderTest, SkipsWhereAskedAndSoDoWhatWaitsForIt) {
  runner_.script("server", {{.exits_after = 5s}});
  EXPECT_EQ(run(R"xml(<executable cmd="server"/>
<executable cmd="b"><depends_on process="server" condition="output" pattern="ready" timeout="2" on_failure="skip"/></executable>
<executable cmd="c"><depends_on process="b" on_failure="skip"/></executable>)xml"),
            0);
  EXPECT_THAT(journal_, ElementsAre("start server-1", "exit server-1"));
  EXPECT_THAT(
      messages_,
      ElementsAre("[b] waits until 'server' has written a line that matches 'ready'", "[c] waits until 'b' has started",
                  "[b] is not started: 2 s have passed and it is still not true that 'server' has written a line "
                  "that matches 'ready' (/test/system.launch.xml:3:22)",
                  "[c] is not started: 'b' was not started (/test/system.launch.xml:4:22)"));
}

TEST_F(StartOrderTest, AnEndWithoutTheLineIsAFailure) {
  runner_.script("server", {{.exits_after = 5s}});
  EXPECT_EQ(run(R"xml(<executable cmd="server"/>
<executable cmd="b"><depends_on process="server" condition="output" pattern="ready"/></executable>)xml"),
            1);
  EXPECT_THAT(errors_, ElementsAre(HasSubstr("error: 'b' can't start: 'server' has ended with exit code 0")));
}

TEST_F(StartOrderTest, ATimerAndAHandlerMayStartWhatWaitsForEarlierProcesses) {
  runner_.script("a", {{.exits_after = 3s}});
  runner_.default_script({.exits_after = 1s});
  EXPECT_EQ(run(R"xml(<executable cmd="a"/>
                   <timer period="1.0"><executable cmd="b"><depends_on process="a"/></executable>
                     <executable cmd="c"><depends_on process="a" condition="exited"/></executable></timer>)xml"),
            0);
  EXPECT_THAT(journal_, ElementsAre("start a-1", "start b-2", "exit b-2", "exit a-1", "start c-3", "exit c-3"));
}

TEST_F(StartOrderTest, AStoppedProcessThatWaitsNeverStarts) {
  runner_.script("a", {{.exits_after = 3s}});
  EXPECT_EQ(run(R"xml(<executable cmd="a"/><executable cmd="b"><depends_on process="a" condition="exited"/></executable>
                   <timer period="1.0"><stop process="b"/></timer>)xml"),
            0);
  EXPECT_THAT(journal_, ElementsAre("start a-1", "exit a-1"));
}

TEST_F(StartOrderTest, AShutdownEndsTheWait) {
  const auto signal = loop_.after(1s, [this] { loop_.deliver_signal(SIGINT); });
  EXPECT_EQ(
      run(R"xml(<executable cmd="a"/><executable cmd="b"><depends_on process="a" condition="exited" exit_code="any"/></executable>)xml"),
      0);
  EXPECT_THAT(journal_, ElementsAre("start a-1", "exit a-1"));
}

TEST_F(StartOrderTest, UnknownAndAmbiguousNamesAreErrorsBeforeAnythingStarts) {
  EXPECT_EQ(run(R"xml(<executable cmd="talker"/>
<executable cmd="talker"/>
<executable cmd="b"><depends_on process="tlaker"/>
<depends_on process="talker"/>
<depends_on process="x"/></executable>)xml"),
            1);
  EXPECT_THAT(journal_, IsEmpty());
  ASSERT_EQ(errors_.size(), 1U);
  EXPECT_EQ(errors_.front(),
            "/test/system.launch.xml:4:22: error: no process is named 'tlaker'\n"
            "    4 | <executable cmd=\"b\"><depends_on process=\"tlaker\"/>\n"
            "      |                      ^~~~~~~~~~\n"
            "      = help: did you mean 'talker'?\n"
            "/test/system.launch.xml:5:2: error: 2 processes are named 'talker'\n"
            "    5 | <depends_on process=\"talker\"/>\n"
            "      |  ^~~~~~~~~~\n"
            "      = help: use the full name of the node, such as /left/talker, or give each a name of its own\n"
            "/test/system.launch.xml:6:2: error: no process is named 'x'\n"
            "    6 | <depends_on process=\"x\"/></executable>\n"
            "      |  ^~~~~~~~~~\n"
            "      = help: what a timer or an event handler starts is not known before it does");
}

TEST_F(StartOrderTest, ACycleIsAnErrorBeforeAnythingStarts) {
  EXPECT_EQ(run(R"xml(<executable cmd="z"/>
<executable cmd="a"><depends_on process="b"/></executable>
<executable cmd="b"><depends_on process="c"/></executable>
<executable cmd="c"><depends_on process="b"/></executable>)xml"),
            1);
  EXPECT_THAT(journal_, IsEmpty());
  EXPECT_THAT(errors_, ElementsAre("/test/system.launch.xml:5:22: error: no start order is possible: 'b' waits for 'c' "
                                   "waits for 'b'\n"
                                   "    5 | <executable cmd=\"c\"><depends_on process=\"b\"/></executable>\n"
                                   "      |                      ^~~~~~~~~~\n"
                                   "      = help: remove one of these depends_on"));
}

// Stands for something outside the launch.
class FakeReadiness : public ReadinessCondition {
 public:
  FakeReadiness(Duration after, std::optional<std::string> failure) : after_(after), failure_(std::move(failure)) {}

  void watch(EventLoop& loop, Done done) override {
    timer_ = loop.after(after_, [this, done = std::move(done)] { done(failure_); });
  }
  std::string describe() const override { return "the moon is full"; }

 private:
  Duration after_;
  std::optional<std::string> failure_;
  EventLoop::SourcePtr timer_;
};

class Outside : public testing::Test {
 protected:
  // Adds a process that waits, and runs the loop for 10 s.
  void add(Duration after, std::optional<std::string> failure, std::optional<Duration> timeout, OnFailure on_failure) {
    ProcessSpec spec;
    spec.name = "wolf";
    Dependency dependency;
    dependency.condition = std::make_shared<FakeReadiness>(after, std::move(failure));
    dependency.timeout = timeout;
    dependency.on_failure = on_failure;
    TrackedProcess& process = table_.add(spec);
    std::vector<Dependency> dependencies;
    dependencies.push_back(std::move(dependency));
    order_.add(std::move(spec), process, std::move(dependencies));
    loop_.advance(10s);
  }

  FakeEventLoop loop_;
  ProcessTable table_;
  std::vector<std::string> journal_;
  StartOrder order_{
      loop_,
      {[this](ProcessSpec spec, TrackedProcess&) {
         journal_.push_back(fmt::format("{} start {}", loop_.now() / 1s, spec.name));
       },
       [this](const LaunchError& error) { journal_.push_back(error.diagnostics().front().message); },
       [this](LogLevel, const std::string& process, const std::string& text) {
         journal_.push_back(process + " " + text);
       },
       [](const TrackedProcess&) {},
       [this](const std::string& process, const Dependency& dependency) {
         journal_.push_back(fmt::format("{} for {}: {}", loop_.now() / 1s, process, describe(dependency)));
       }}};
};

TEST_F(Outside, AConditionIsWatched) {
  add(3s, std::nullopt, 4s, OnFailure::kShutdown);
  EXPECT_THAT(journal_,
              ElementsAre("wolf waits until the moon is full", "3 for wolf: the moon is full", "3 start wolf"));
  EXPECT_TRUE(order_.empty());
}

TEST_F(Outside, AConditionMayFail) {
  add(3s, "there is no moon", 4s, OnFailure::kShutdown);
  EXPECT_THAT(journal_, ElementsAre("wolf waits until the moon is full", "'wolf' can't start: there is no moon"));
  EXPECT_TRUE(order_.empty());
}

TEST_F(Outside, AConditionMayComeTooLate) {
  add(5s, std::nullopt, 4s, OnFailure::kShutdown);
  EXPECT_THAT(journal_,
              ElementsAre("wolf waits until the moon is full",
                          "'wolf' can't start: 4 s have passed and it is still not true that the moon is full"));
}

}  // namespace
}  // namespace launch
