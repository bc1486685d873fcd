// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <algorithm>

#include "supervisor_fixture.hpp"

namespace launch {
namespace {

using namespace std::chrono_literals;

class Respawn : public SupervisorFixture {
 protected:
  static ProcessSpec respawning(Duration delay, std::int64_t max_retries = -1) {
    ProcessSpec result = spec("a");
    result.respawn = {.enabled = true, .delay = delay, .max_retries = max_retries};
    return result;
  }
};

TEST_F(Respawn, StartsAgainAfterTheDelayAlsoWhenTheExitCodeIsZero) {
  runner.script("a", {{.exits_after = 1s}});
  supervisor->start(respawning(2s));
  loop.advance(1s);
  EXPECT_EQ(supervisor->state(1), ProcessState::kRespawnDelay);
  EXPECT_EQ(supervisor->active(), 1U);
  loop.advance(3s);
  EXPECT_EQ(lines, (Lines{"0.0 a-1 started", "1.0 a-1 exited 0, again", "3.0 a-1 started", "4.0 a-1 exited 0, again"}));
}

TEST_F(Respawn, StopsAfterMaxRetries) {
  runner.script("a", {{.exits_after = 1s, .exit_code = 1}});
  supervisor->start(respawning(0s, 2));
  loop.advance(60s);
  EXPECT_EQ(lines, (Lines{"0.0 a-1 started", "1.0 a-1 exited 1, again", "1.0 a-1 started", "2.0 a-1 exited 1, again",
                          "2.0 a-1 started", "3.0 a-1 exited 1", "3.0 a-1 done"}));
}

TEST_F(Respawn, MaxRetriesOfZeroMeansNever) {
  runner.script("a", {{.exits_after = 1s}});
  supervisor->start(respawning(0s, 0));
  loop.advance(60s);
  EXPECT_EQ(lines, (Lines{"0.0 a-1 started", "1.0 a-1 exited 0", "1.0 a-1 done"}));
}

TEST_F(Respawn, TriesAFailedStartAgainButNotSoonerThanASecond) {
  runner.script("a", {{.spawn_error = ENOENT}, {}});
  supervisor->start(respawning(0s));
  loop.advance(60s);
  EXPECT_EQ(lines,
            (Lines{"0.0 a-1 failed: cannot start '/bin/a': No such file or directory, again", "1.0 a-1 started"}));
}

TEST_F(Respawn, CountsFailedStartsAsRetries) {
  runner.script("a", {{.spawn_error = ENOENT}});
  supervisor->start(respawning(3s, 1));
  loop.advance(60s);
  EXPECT_EQ(lines, (Lines{"0.0 a-1 failed: cannot start '/bin/a': No such file or directory, again",
                          "3.0 a-1 failed: cannot start '/bin/a': No such file or directory", "3.0 a-1 done"}));
}

TEST_F(Respawn, WithoutADelaySlowsDownAProgramThatEndsAtOnce) {
  runner.script("a", {{.exits_after = 10ms, .exit_code = 1}});
  supervisor->start(respawning(0s));
  loop.advance(99ms);
  EXPECT_EQ(runner.spawned().size(), 10U);
  take_lines();
  loop.advance(60s);
  EXPECT_EQ(lines.at(1), "0.1 a-1 slowed after 10 runs");
  EXPECT_EQ(std::count(lines.begin(), lines.end(), lines.at(1)), 1);
  std::vector<double> waits;
  for (std::size_t i = 10; i < 18; ++i) {
    waits.push_back(std::chrono::duration<double>(runner.spawned().at(i).at - runner.spawned().at(i - 1).at).count());
  }
  EXPECT_THAT(waits, testing::Pointwise(testing::DoubleNear(1e-6), {0.11, 0.21, 0.41, 0.81, 1.61, 3.21, 5.01, 5.01}));
}

TEST_F(Respawn, ALongRunEndsTheSlowness) {
  std::vector<FakeScript> runs(12, {.exits_after = 10ms});
  runs.push_back({.exits_after = 1s});
  runs.push_back({.exits_after = 10ms});
  runner.script("a", runs);
  supervisor->start(respawning(0s));
  loop.advance(2100ms);
  EXPECT_GE(runner.spawned().size(), 20U) << "the next short runs follow at once";
}

TEST_F(Respawn, ADelayOfTheFileIsKept) {
  runner.script("a", {{.exits_after = 10ms}});
  supervisor->start(respawning(10ms));
  loop.advance(1s);
  EXPECT_GE(runner.spawned().size(), 50U);
}

TEST_F(Respawn, ShutdownDropsAPendingRespawn) {
  runner.script("a", {{.exits_after = 1s}});
  supervisor->start(respawning(10s));
  loop.advance(2s);
  take_lines();
  supervisor->shutdown();
  EXPECT_EQ(lines, (Lines{"2.0 a-1 done"}));
  loop.advance(60s);
  EXPECT_EQ(runner.spawned().size(), 1U);
}

TEST_F(Respawn, ShutdownByTheObserverOfTheExitDropsTheRespawn) {
  runner.script("a", {{.exits_after = 1s}});
  supervisor->observe([this](const ProcessEvent& event) {
    if (std::holds_alternative<ProcessExited>(event.what)) {
      supervisor->shutdown();
    }
  });
  supervisor->start(respawning(0s));
  loop.advance(60s);
  EXPECT_EQ(lines.back(), "1.0 a-1 done");
  EXPECT_EQ(runner.spawned().size(), 1U);
}

TEST_F(Respawn, DoesNotHappenAfterShutdown) {
  supervisor->start(respawning(0s));
  supervisor->shutdown();
  loop.advance(60s);
  EXPECT_EQ(lines, (Lines{"0.0 a-1 started", "0.0 a-1 SIGINT", "0.0 a-1 exited -2, expected", "0.0 a-1 done"}));
}

TEST_F(Respawn, FollowsARequestedSignal) {
  supervisor->start(respawning(1s));
  supervisor->signal(1, SIGTERM);
  loop.advance(1s);
  EXPECT_EQ(lines,
            (Lines{"0.0 a-1 started", "0.0 a-1 SIGTERM", "0.0 a-1 exited -15, expected, again", "1.0 a-1 started"}));
}

TEST_F(Respawn, KillAllLeavesAPendingRespawn) {
  runner.script("a", {{.exits_after = 1s}});
  supervisor->start(respawning(10s));
  loop.advance(2s);
  const std::size_t before = runner.signals().size();
  supervisor->kill_all();
  EXPECT_EQ(supervisor->state(1), ProcessState::kRespawnDelay);
  EXPECT_EQ(runner.signals().size(), before);
}

TEST_F(Respawn, KeepsArgumentsOfGeneratedFiles) {
  runner.script("a", {{.exits_after = 1s}});
  ProcessSpec with_file = respawning(0s);
  with_file.argv = {"/bin/a", "?"};
  with_file.files = {{1, "params.yaml", "x: 1\n"}};
  supervisor->start(with_file);
  loop.advance(1s);
  ASSERT_EQ(runner.spawned().size(), 2U);
  EXPECT_EQ(runner.spawned()[1].spec.argv, runner.spawned()[0].spec.argv);
}

TEST_F(Respawn, ShowsTheOutputOfEveryRun) {
  runner.script("a", {{.exits_after = 1s, .output = {{.text = "first"}}}, {.output = {{.text = "second\n"}}}});
  supervisor->start(respawning(0s));
  loop.advance(2s);
  EXPECT_EQ(screen.text(), "[a-1] first\n[a-1] second\n");
}

}  // namespace
}  // namespace launch
