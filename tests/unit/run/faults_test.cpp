// SPDX-License-Identifier: Apache-2.0
// The faults of a test: when each is applied, and what becomes of its process.
#include <fmt/ranges.h>
#include <signal.h>
#include <sys/resource.h>

#include "tests/unit/run/launch_service_fixture.hpp"

namespace launch {
namespace {

using namespace std::chrono_literals;
using testing::ElementsAre;
using testing::IsEmpty;

constexpr const char* kTest = "<test name=\"t\"><output text=\"a\"/>";

class FaultsTest : public LaunchServiceTest {
 protected:
  // Runs the actions with the faults in a test. Notes what happens in events_.
  int run_with(const std::string& actions, const std::string& faults) {
    const auto file =
        std::make_shared<SourceFile>("/t.launch.xml", "<launch>" + actions + kTest + faults + "</test></launch>");
    LaunchContext context(registry_, {{"PATH", "/bin"}}, "", [](auto...) {});
    context.tests().take(0);
    LaunchService service(context, loop_, supervisor_,
                          [this](const LaunchError& error) { errors_.emplace_back(error.what()); });
    service.test().use(
        {[](const TestRequest&) {}, [](auto&&...) {}, [] {}, [this](const FaultEvent& event) { note(event); }});
    return service.run(*parse_launch_description(file, registry_));
  }

  void note(const FaultEvent& event) {
    const double now = std::chrono::duration<double>(loop_.now()).count();
    switch (event.kind) {
      case FaultEvent::Kind::kApplied:
        events_.push_back(fmt::format("{:g} s: {} applied to {}", now, event.number, fmt::join(event.labels, " ")));
        break;
      case FaultEvent::Kind::kOver:
        events_.push_back(fmt::format("{:g} s: {} over", now, event.number));
        break;
      case FaultEvent::Kind::kMissed:
        events_.push_back(fmt::format("{:g} s: {} missed: {}", now, event.number, event.reason));
        break;
    }
  }

  // "2 s: SIGSTOP", …
  std::vector<std::string> signals() const {
    std::vector<std::string> all;
    for (const FakeProcessRunner::Signalled& sent : runner_.signals()) {
      all.push_back(
          fmt::format("{:g} s: SIG{}", std::chrono::duration<double>(sent.at).count(), sigabbrev_np(sent.signal)));
    }
    return all;
  }

  std::vector<std::string> events_;
};

TEST_F(FaultsTest, KillsAtItsTime) {
  runner_.default_script({.exits_after = 9s});
  run_with(R"(<executable cmd="p"/>)", R"(<fault process="p" do="kill" at="2"/>)");
  EXPECT_THAT(errors_, IsEmpty());
  EXPECT_THAT(events_, ElementsAre("2 s: 1 applied to p-1", "2 s: 1 over"));
  EXPECT_EQ(runner_.signals().front().signal, SIGKILL);
  EXPECT_EQ(runner_.signals().front().at, 2s);
  EXPECT_EQ(loop_.now(), 2s);
}

TEST_F(FaultsTest, WaitsForTheNthLineAndThenForItsTime) {
  runner_.script(
      "p", {{.exits_after = 9s, .output = {{.at = 1s, .text = "item 1\nother\n"}, {.at = 2s, .text = "item 2\n"}}}});
  run_with(R"(<executable cmd="p"/>)", R"xml(<fault process="p" do="kill" signal="SIGTERM" at="0.5">
    <depends_on process="p" condition="output" pattern="item" occurrence="2"/></fault>)xml");
  EXPECT_THAT(events_, ElementsAre("2.5 s: 1 applied to p-1", "2.5 s: 1 over"));
  EXPECT_EQ(loop_.now(), 2500ms);
}

TEST_F(FaultsTest, StopsForATime) {
  runner_.default_script({.exits_after = 9s});
  run_with(R"(<executable cmd="p"/>)", R"(<fault process="p" do="stop" at="1" for="3"/>)");
  EXPECT_THAT(events_, ElementsAre("1 s: 1 applied to p-1", "4 s: 1 over"));
  EXPECT_THAT(signals(), ElementsAre("1 s: SIGSTOP", "4 s: SIGCONT"));
}

TEST_F(FaultsTest, AProcessThatTwoFaultsHoldGoesOnAfterBoth) {
  runner_.default_script({.exits_after = 9s});
  run_with(R"(<executable cmd="p"/>)",
           R"(<fault process="p" do="stop" at="1" for="3"/><fault process="p" do="stop" at="2" for="4"/>)");
  EXPECT_THAT(signals(), ElementsAre("1 s: SIGSTOP", "6 s: SIGCONT"));
}

TEST_F(FaultsTest, SlowsByTurns) {
  runner_.default_script({.exits_after = 9s});
  run_with(R"(<executable cmd="p"/>)", R"(<fault process="p" do="slow" to="25%" at="1" for="0.25"/>)");
  EXPECT_THAT(signals(), ElementsAre("1 s: SIGSTOP", "1.075 s: SIGCONT", "1.1 s: SIGSTOP", "1.175 s: SIGCONT",
                                     "1.2 s: SIGSTOP", "1.25 s: SIGCONT"));
}

TEST_F(FaultsTest, LimitsAndLifts) {
  runner_.default_script({.exits_after = 9s});
  run_with(R"(<executable cmd="p"/>)", R"(<fault process="p" do="limit" memory="1K" files="7" at="1" for="2"/>)");
  std::vector<std::string> limits;
  for (const FakeProcessRunner::Limited& limited : runner_.limits()) {
    limits.push_back(fmt::format("{:g} s: {} {}", std::chrono::duration<double>(limited.at).count(),
                                 limited.resource == RLIMIT_AS ? "memory" : "files", limited.soft));
  }
  EXPECT_THAT(limits, ElementsAre("1 s: memory 1024", "1 s: files 7", "3 s: memory 1000000", "3 s: files 1000000"));
}

TEST_F(FaultsTest, TheNextRunOfAProcessIsFree) {
  runner_.script("p", {{.exits_after = 2s, .exit_code = 1}, {.exits_after = 5s}});
  run_with(R"(<executable cmd="p" respawn="true" respawn_max_retries="1"/>)",
           R"(<fault process="p" do="stop" at="1" for="3"/>
              <fault process="p" do="limit" files="3" at="1" for="3"/>)");
  EXPECT_THAT(signals(), ElementsAre("1 s: SIGSTOP", "2 s: SIGKILL"));  // the latter for what the run has left
  EXPECT_EQ(runner_.limits().size(), 1U);
}

TEST_F(FaultsTest, AClockGetsItsCommandsAndTheirOpposites) {
  runner_.default_script({.exits_after = 9s});
  std::vector<std::string> input;
  std::vector<EventLoop::SourcePtr> sources;
  for (int second = 1; second <= 4; ++second) {
    sources.push_back(
        loop_.after(second * 1s + 500ms, [&] { input.push_back(runner_.take_input(runner_.spawned().front().pid)); }));
  }
  run_with(R"(<clock rate="2"/>)", R"(<fault clock="clock" do="stop" at="1" for="2"/>
                                      <fault clock="clock" do="skew" rate="0.5" at="2" for="2"/>
                                      <fault clock="clock" do="jump" by="-3" at="4"/>)");
  EXPECT_THAT(errors_, IsEmpty());
  EXPECT_THAT(input, ElementsAre("stop\n", "scale 0.5\n", "go\n", "jump -3\nscale 2\n"));
  EXPECT_EQ(events_.front(), "1 s: 1 applied to clock-1");
}

TEST_F(FaultsTest, OnlyAClockHasSimulatedTime) {
  runner_.default_script({.exits_after = 9s});
  run_with(R"(<executable cmd="p"/>)", R"(<fault clock="p" do="stop" at="1"/>)");
  EXPECT_THAT(events_, ElementsAre("1 s: 1 applied to p-1", "1 s: 1 missed: 'p' is no clock"));
}

TEST_F(FaultsTest, SaysWhyItCouldNotBeApplied) {
  runner_.script("p", {{.exits_after = 1s, .exit_code = 4}});
  runner_.script("q", {{.exits_after = 9s}});
  run_with(R"(<executable cmd="p"/><executable cmd="q"/>)",
           R"xml(<fault process="p" do="kill" at="2"/>
                 <fault process="q" do="kill"><depends_on process="p" condition="output" pattern="x"/></fault>
                 <fault process="q" do="kill"><depends_on process="q" condition="output" timeout="3"/></fault>)xml");
  EXPECT_THAT(events_,
              ElementsAre("1 s: 2 missed: 'p' has ended with exit code 4", "2 s: 1 missed: 'p' did not run",
                          "3 s: 3 missed: 3 s have passed and it is still not true that 'q' has written any line"));
}

TEST_F(FaultsTest, WhatStandsStillGoesOnAtTheShutdown) {
  runner_.script("p", {{.exits_after = 9s}});
  runner_.script("q", {{.exits_after = 2s}});
  run_with(R"(<executable cmd="p"/><executable cmd="q" on_exit="shutdown"/>)",
           R"(<fault process="p" do="stop" at="1"/><fault process="p" do="kill" at="5"/>)");
  EXPECT_THAT(events_, ElementsAre("1 s: 1 applied to p-1", "1 s: 1 over"));
  EXPECT_THAT(signals(), ElementsAre("1 s: SIGSTOP", "2 s: SIGCONT", "2 s: SIGINT", "2 s: SIGKILL"));
}

TEST_F(FaultsTest, NothingWaitsForAFault) {
  runner_.default_script({.exits_after = 1s});
  run_with(R"(<executable cmd="p"/>)", R"(<fault process="p" do="kill" at="100"/>)");
  EXPECT_THAT(events_, IsEmpty());
  EXPECT_EQ(loop_.now(), 1s);
}

TEST_F(FaultsTest, AKilledProcessRespawns) {
  runner_.script("p", {{.exits_after = 9s}, {.exits_after = 2s}});
  run_with(R"(<executable cmd="p" respawn="true" respawn_max_retries="1"/>)",
           R"(<fault process="p" do="kill" at="1"/>)");
  EXPECT_EQ(runner_.spawned().size(), 2U);
}

}  // namespace
}  // namespace launch
