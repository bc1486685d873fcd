// SPDX-License-Identifier: Apache-2.0
// stop(), restart() and respawn delays that grow.
#include "supervisor_fixture.hpp"

namespace launch {
namespace {

using namespace std::chrono_literals;

class StopRestart : public SupervisorFixture {
 protected:
  static ProcessSpec respawning() {
    ProcessSpec result = spec("a");
    result.respawn.enabled = true;
    return result;
  }
};

TEST_F(StopRestart, StopEndsAProcessForGood) {
  supervisor->start(respawning());
  loop.advance(1s);
  supervisor->stop(1);
  loop.advance(1s);
  EXPECT_EQ(lines, (Lines{"0.0 a-1 started", "1.0 a-1 SIGINT", "1.0 a-1 exited -2, expected", "1.0 a-1 done"}));
}

TEST_F(StopRestart, StopEscalatesAsAShutdownDoes) {
  runner.script("a", {{.ignores = {SIGINT, SIGTERM}}});
  supervisor->start(spec("a"));
  supervisor->stop(1);
  loop.advance(60s);
  EXPECT_EQ(lines, (Lines{"0.0 a-1 started", "0.0 a-1 SIGINT", "5.0 a-1 SIGTERM after SIGINT and 5 s",
                          "10.0 a-1 SIGKILL after SIGTERM and 5 s", "10.0 a-1 exited -9, expected", "10.0 a-1 done"}));
}

TEST_F(StopRestart, StopDropsAPendingRespawn) {
  runner.script("a", {{.exits_after = 1s}});
  ProcessSpec slow = respawning();
  slow.respawn.delay = 10s;
  supervisor->start(slow);
  loop.advance(2s);
  supervisor->stop(1);
  loop.advance(60s);
  EXPECT_EQ(lines, (Lines{"0.0 a-1 started", "1.0 a-1 exited 0, again", "2.0 a-1 done"}));
}

TEST_F(StopRestart, RestartWaitsForTheEndAndStartsAgain) {
  runner.script("a", {{.dies_after = 2s}, {}});
  supervisor->start(spec("a"));
  loop.advance(1s);
  supervisor->restart(1);
  supervisor->restart(1);  // once is enough
  loop.advance(60s);
  EXPECT_EQ(lines,
            (Lines{"0.0 a-1 started", "1.0 a-1 SIGINT", "3.0 a-1 exited -2, expected, again", "3.0 a-1 started"}));
  EXPECT_EQ(supervisor->active(), 1U);
}

TEST_F(StopRestart, TheLastOfStopAndRestartCounts) {
  runner.script("a", {{.dies_after = 2s}, {}});
  runner.script("b", {{.dies_after = 2s}, {}});
  supervisor->start(spec("a"));
  supervisor->start(spec("b"));
  take_lines();
  supervisor->restart(1);
  supervisor->stop(1);
  supervisor->stop(2);
  supervisor->restart(2);
  loop.advance(60s);
  EXPECT_EQ(lines, (Lines{"0.0 a-1 SIGINT", "0.0 b-2 SIGINT", "2.0 a-1 exited -2, expected", "2.0 a-1 done",
                          "2.0 b-2 exited -2, expected, again", "2.0 b-2 started"}));
}

TEST_F(StopRestart, RestartRevivesAProcessThatIsDone) {
  runner.script("a", {{.exits_after = 1s}});
  supervisor->start(spec("a"));
  loop.advance(5s);
  EXPECT_EQ(supervisor->active(), 0U);
  supervisor->restart(1);
  EXPECT_EQ(supervisor->active(), 1U);
  loop.advance(5s);
  EXPECT_EQ(supervisor->active(), 0U);
  EXPECT_EQ(lines, (Lines{"0.0 a-1 started", "1.0 a-1 exited 0", "1.0 a-1 done", "5.0 a-1 started", "6.0 a-1 exited 0",
                          "6.0 a-1 done"}));
}

TEST_F(StopRestart, RestartKillsWhatTheEndedProcessHasLeft) {
  runner.script("a", {{.exits_after = 1s, .descendants_for = 60s}, {}});
  supervisor->start(spec("a"));
  loop.advance(5s);
  supervisor->restart(1);
  EXPECT_EQ(runner.signals_of(pid_of_start(0)), (std::vector<int>{SIGKILL}));
  EXPECT_EQ(runner.unreaped(), 1U);
}

TEST_F(StopRestart, RestartCutsARespawnDelayAndCountsRetriesAnew) {
  runner.script("a", {{.exits_after = 1s}});
  ProcessSpec slow = respawning();
  slow.respawn.delay = 10s;
  slow.respawn.max_retries = 1;
  supervisor->start(slow);
  loop.advance(2s);
  supervisor->restart(1);
  loop.advance(60s);
  EXPECT_EQ(lines, (Lines{"0.0 a-1 started", "1.0 a-1 exited 0, again", "2.0 a-1 started", "3.0 a-1 exited 0, again",
                          "13.0 a-1 started", "14.0 a-1 exited 0", "14.0 a-1 done"}));
}

TEST_F(StopRestart, NothingIsRestartedAfterAShutdown) {
  runner.script("a", {{.dies_after = 2s}});
  supervisor->start(spec("a"));
  supervisor->restart(1);
  supervisor->shutdown();
  loop.advance(60s);
  supervisor->restart(1);
  EXPECT_EQ(lines, (Lines{"0.0 a-1 started", "0.0 a-1 SIGINT", "2.0 a-1 exited -2, expected", "2.0 a-1 done"}));
}

TEST_F(StopRestart, ABackOffMakesDelaysLongerUpToTheLongest) {
  runner.script("a", {{.exits_after = 1s, .exit_code = 1}});
  ProcessSpec patient = respawning();
  patient.respawn.delay = 1s;
  patient.respawn.backoff = 2.0;
  patient.respawn.max_delay = 5s;
  supervisor->start(patient);
  loop.advance(18s);
  EXPECT_EQ(lines, (Lines{"0.0 a-1 started", "1.0 a-1 exited 1, again",       // waits 1
                          "2.0 a-1 started", "3.0 a-1 exited 1, again",       // 2
                          "5.0 a-1 started", "6.0 a-1 exited 1, again",       // 4
                          "10.0 a-1 started", "11.0 a-1 exited 1, again",     // 5
                          "16.0 a-1 started", "17.0 a-1 exited 1, again"}));  // 5
}

TEST_F(StopRestart, ALongRunEndsTheBackOff) {
  runner.script("a", {{.exits_after = 1s}, {.exits_after = 1s}, {.exits_after = 10s}, {}});
  ProcessSpec patient = respawning();
  patient.respawn.delay = 1s;
  patient.respawn.backoff = 3.0;
  patient.respawn.max_delay = 9s;
  supervisor->start(patient);
  loop.advance(60s);
  EXPECT_EQ(lines, (Lines{"0.0 a-1 started", "1.0 a-1 exited 0, again", "2.0 a-1 started", "3.0 a-1 exited 0, again",
                          "6.0 a-1 started", "16.0 a-1 exited 0, again", "17.0 a-1 started"}));
}

TEST_F(StopRestart, LinesAreObservedBeforeTheExit) {
  runner.script("a", {{.exits_after = 1s, .output = {{.at = 0s, .text = "one\ntw"}, {.at = 1s, .text = "o\nrest"}}}});
  supervisor->observe_output([this](const ProcessSpec& spec, ProcessId id, const std::string& label,
                                    OutputStream stream, std::string_view line) {
    lines.push_back(
        fmt::format("{} {} {} {}: {}", spec.name, id, label, stream == OutputStream::kOut ? "out" : "err", line));
  });
  ProcessSpec silent = spec("a");
  silent.output = {};
  supervisor->start(silent);
  loop.advance(1s);
  EXPECT_EQ(lines, (Lines{"0.0 a-1 started", "a 1 a-1 out: one", "a 1 a-1 out: two", "a 1 a-1 out: rest",
                          "1.0 a-1 exited 0", "1.0 a-1 done"}));
  EXPECT_EQ(screen.text(), "");
}

}  // namespace
}  // namespace launch
