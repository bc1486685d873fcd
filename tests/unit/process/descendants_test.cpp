// SPDX-License-Identifier: Apache-2.0
// The group of a process when the process itself exits first. FakeProcessRunner checks that the number of the process
// is never used after the process was reaped: it throws then.
#include "supervisor_fixture.hpp"

namespace launch {
namespace {

using namespace std::chrono_literals;

class Descendants : public SupervisorFixture {};

TEST_F(Descendants, ThatHoldTheOutputDoNotDelayTheReportOfAnExit) {
  runner.script("a", {{.exits_after = 1s, .output = {{.at = 3s, .text = "late\n"}}, .descendants_for = 10s}});
  supervisor->start(spec("a"));
  loop.advance(1s);
  EXPECT_EQ(lines, (Lines{"0.0 a-1 started", "1.0 a-1 exited 0", "1.0 a-1 done"}));
  EXPECT_EQ(runner.unreaped(), 1U) << "the number of the group stays reserved";
  loop.advance(3s);
  EXPECT_EQ(screen.text(), "[a-1] late\n");
  loop.advance(10s);
  EXPECT_EQ(runner.unreaped(), 0U);
}

TEST_F(Descendants, OfAProcessThatExitedOnItsOwnAreInterruptedAtShutdownAndKilledAtTheEnd) {
  runner.script("a", {{.exits_after = 1s, .ignores = {SIGINT}, .descendants_for = 100s}});
  supervisor->start(spec("a"));
  loop.advance(1s);
  supervisor->shutdown();
  supervisor.reset();
  EXPECT_EQ(runner.signals_of(pid_of_start(0)), (std::vector<int>{SIGINT, SIGKILL}));
  EXPECT_EQ(runner.unreaped(), 0U);
}

TEST_F(Descendants, AreKilledByKillAll) {
  runner.script("a", {{.exits_after = 1s, .ignores = {SIGINT, SIGTERM}, .descendants_for = 100s}});
  supervisor->start(spec("a"));
  loop.advance(1s);
  supervisor->kill_all();
  EXPECT_EQ(runner.signals_of(pid_of_start(0)), (std::vector<int>{SIGKILL}));
  EXPECT_EQ(runner.unreaped(), 0U);
}

TEST_F(Descendants, HaveTheRestOfTheTimeWhenAnInterruptedProcessExitsBeforeThem) {
  runner.script("a", {{.dies_after = 1s, .descendants_for = 2s}});
  supervisor->start(spec("a"));
  supervisor->shutdown();
  loop.advance(60s);
  EXPECT_EQ(lines, (Lines{"0.0 a-1 started", "0.0 a-1 SIGINT", "1.0 a-1 exited -2, expected", "3.0 a-1 done"}));
  EXPECT_EQ(runner.unreaped(), 0U);
}

TEST_F(Descendants, ThatHaveLeftTheGroupAreNotWaitedFor) {
  runner.script("a", {{.ignores = {SIGTERM},
                       .output = {{.at = 3s, .text = "of a daemon\n"}},
                       .descendants_for = 100s,
                       .descendants_leave_after = 0s}});
  supervisor->start(spec("a"));
  supervisor->shutdown();
  loop.advance(5s);
  EXPECT_EQ(lines, (Lines{"0.0 a-1 started", "0.0 a-1 SIGINT", "0.0 a-1 exited -2, expected", "0.1 a-1 done"}));
  EXPECT_EQ(screen.text(), "[a-1] of a daemon\n") << "its output is shown as long as the launcher runs";
  EXPECT_EQ(supervisor->active(), 0U);
  supervisor.reset();
  EXPECT_EQ(runner.unreaped(), 0U);
}

TEST_F(Descendants, AreWaitedForUntilTheyLeaveTheGroup) {
  runner.script("a", {{.ignores = {SIGTERM}, .descendants_for = 100s, .descendants_leave_after = 6050ms}});
  runner.script("b", {{.ignores = {SIGTERM}, .descendants_for = 7s}});
  supervisor->start(spec("a"));
  supervisor->start(spec("b"));
  supervisor->shutdown();
  loop.advance(4s);
  take_lines();
  loop.advance(60s);
  EXPECT_EQ(lines, (Lines{"5.0 a-1 SIGTERM after SIGINT and 5 s", "5.0 b-2 SIGTERM after SIGINT and 5 s",
                          "6.1 a-1 done", "7.0 b-2 done"}));
}

TEST_F(Descendants, ThatHaveLeftTheGroupDoNotDelayARestart) {
  runner.script("a", {{.descendants_for = 100s, .descendants_leave_after = 0s}, {}});
  const ProcessId id = supervisor->start(spec("a"));
  supervisor->restart(id);
  loop.advance(1s);
  EXPECT_EQ(lines,
            (Lines{"0.0 a-1 started", "0.0 a-1 SIGINT", "0.0 a-1 exited -2, expected, again", "0.1 a-1 started"}));
  EXPECT_EQ(runner.unreaped(), 1U) << "only the new run";
}

TEST_F(Descendants, GetTimeToEndAndThenSigkill) {
  runner.script("a", {{.ignores = {SIGTERM}, .descendants_for = 100s}});
  supervisor->start(spec("a"));
  supervisor->shutdown();
  loop.run_until_idle();
  EXPECT_EQ(lines, (Lines{"0.0 a-1 started", "0.0 a-1 SIGINT", "0.0 a-1 exited -2, expected"}));
  EXPECT_EQ(supervisor->active(), 1U);
  take_lines();
  loop.advance(10s);
  EXPECT_EQ(lines,
            (Lines{"5.0 a-1 SIGTERM after SIGINT and 5 s", "10.0 a-1 SIGKILL after SIGTERM and 5 s", "10.0 a-1 done"}));
  EXPECT_EQ(runner.unreaped(), 0U);
}

TEST_F(Descendants, ThatEndInTimeAreNotKilledByName) {
  runner.script("a", {{.ignores = {SIGTERM}, .descendants_for = 2s}});
  supervisor->start(spec("a"));
  supervisor->shutdown();
  loop.advance(60s);
  EXPECT_EQ(lines, (Lines{"0.0 a-1 started", "0.0 a-1 SIGINT", "0.0 a-1 exited -2, expected", "2.0 a-1 done"}));
}

TEST_F(Descendants, AreKilledWithAKilledProcess) {
  runner.script("a", {{.ignores = {SIGINT, SIGTERM}, .descendants_for = 100s}});
  supervisor->start(spec("a"));
  supervisor->kill_all();
  loop.run_until_idle();
  EXPECT_EQ(lines, (Lines{"0.0 a-1 started", "0.0 a-1 SIGKILL", "0.0 a-1 exited -9, expected", "0.0 a-1 done"}));
}

TEST_F(Descendants, WaitingForTheirEndAreKilledByKillAll) {
  runner.script("a", {{.ignores = {SIGTERM}, .descendants_for = 100s}});
  supervisor->start(spec("a"));
  supervisor->shutdown();
  loop.run_until_idle();
  take_lines();
  supervisor->kill_all();
  EXPECT_EQ(lines, (Lines{"0.0 a-1 SIGKILL", "0.0 a-1 done"}));
  EXPECT_EQ(runner.unreaped(), 0U);
}

TEST_F(Descendants, AreKilledBeforeARespawn) {
  runner.script("a", {{.exits_after = 1s, .ignores = {SIGINT, SIGTERM}, .descendants_for = 100s}, {}});
  ProcessSpec respawning = spec("a");
  respawning.respawn.enabled = true;
  supervisor->start(respawning);
  loop.advance(1s);
  EXPECT_EQ(lines, (Lines{"0.0 a-1 started", "1.0 a-1 exited 0, again", "1.0 a-1 started"}));
  EXPECT_EQ(runner.signals_of(pid_of_start(0)), (std::vector<int>{SIGKILL}));
  EXPECT_EQ(runner.unreaped(), 1U) << "only the new run";
}

}  // namespace
}  // namespace launch
