// SPDX-License-Identifier: Apache-2.0
// How often a process may start, and what it costs to be unhealthy.
#include <gmock/gmock.h>

#include "launcher/process/process_messages.hpp"
#include "supervisor_fixture.hpp"

namespace launch {
namespace {

using namespace std::chrono_literals;
using testing::ElementsAre;
using testing::IsEmpty;

class StartLimits : public SupervisorFixture {
 protected:
  // Ends with 1 after each second, and starts again at once.
  ProcessSpec flapping(std::int64_t starts, Duration within, std::optional<Duration> cool_down = std::nullopt) {
    runner.script("a", {{.exits_after = 1s, .exit_code = 1}});
    ProcessSpec process = spec("a");
    process.respawn.enabled = true;
    process.start_limit = {starts, within, cool_down};
    return process;
  }
};

TEST_F(StartLimits, GiveAProcessUp) {
  supervisor->start(flapping(3, 10s));
  loop.advance(60s);
  EXPECT_THAT(take_lines(),
              ElementsAre("0.0 a-1 started", "1.0 a-1 exited 1, again", "1.0 a-1 started", "2.0 a-1 exited 1, again",
                          "2.0 a-1 started", "3.0 a-1 exited 1", "3.0 a-1 3 starts reached", "3.0 a-1 done"));
}

TEST_F(StartLimits, CountOnlyRecentStarts) {
  supervisor->start(flapping(3, 1500ms));
  loop.advance(60s);
  EXPECT_EQ(supervisor->view(1).runs, 61);
}

TEST_F(StartLimits, MayEndAfterACoolDown) {
  supervisor->start(flapping(2, 10s, 20s));
  loop.advance(25s);
  EXPECT_THAT(take_lines(),
              ElementsAre("0.0 a-1 started", "1.0 a-1 exited 1, again", "1.0 a-1 started", "2.0 a-1 exited 1, again",
                          "2.0 a-1 2 starts reached, cools down", "22.0 a-1 started", "23.0 a-1 exited 1, again",
                          "23.0 a-1 started", "24.0 a-1 exited 1, again", "24.0 a-1 2 starts reached, cools down"));
}

TEST_F(StartLimits, CountStartsThatFail) {
  runner.script("b", {{.spawn_error = ENOENT}});
  ProcessSpec process = spec("b");
  process.respawn.enabled = true;
  process.start_limit = {2, 60s, {}, false};
  supervisor->start(process);
  loop.advance(60s);
  EXPECT_EQ(take_lines().size(), 4U);  // two failures, the limit, and the end
  EXPECT_EQ(supervisor->active(), 0U);
}

TEST_F(StartLimits, DoNotCountWhatAUserAsksFor) {
  runner.default_script({});
  ProcessSpec process = spec("a");
  process.start_limit = {2, 60s, {}, false};
  const ProcessId id = supervisor->start(process);
  for (int i = 0; i < 5; ++i) {
    supervisor->restart(id);
    loop.advance(1s);
  }
  EXPECT_EQ(supervisor->view(id).runs, 6);
}

TEST_F(StartLimits, BeginAnewWhenAUserStartsTheProcess) {
  const ProcessId id = supervisor->start(flapping(2, 60s));
  loop.advance(10s);
  take_lines();
  supervisor->restart(id);
  loop.advance(10s);
  EXPECT_THAT(take_lines(), ElementsAre("10.0 a-1 started", "11.0 a-1 exited 1, again", "11.0 a-1 started",
                                        "12.0 a-1 exited 1", "12.0 a-1 2 starts reached", "12.0 a-1 done"));
}

TEST_F(StartLimits, CountRestartsOfAnUnhealthyProcess) {
  runner.default_script({});
  ProcessSpec process = spec("a");
  process.start_limit = {2, 60s, {}, false};
  const ProcessId id = supervisor->start(process);
  loop.advance(1s);
  supervisor->restart_unhealthy(id);
  loop.advance(1s);
  EXPECT_EQ(supervisor->view(id).runs, 2);
  take_lines();
  supervisor->restart_unhealthy(id);
  loop.advance(1s);
  EXPECT_THAT(take_lines(),
              ElementsAre("2.0 a-1 SIGINT", "2.0 a-1 exited -2, expected", "2.0 a-1 2 starts reached", "2.0 a-1 done"));
}

TEST_F(StartLimits, ARestartOfAnUnhealthyProcessIsNoRetry) {
  runner.default_script({});
  ProcessSpec process = spec("a");
  process.respawn.enabled = true;
  process.respawn.max_retries = 1;
  const ProcessId id = supervisor->start(process);
  for (int i = 0; i < 3; ++i) {
    supervisor->restart_unhealthy(id);
    loop.advance(1s);
  }
  EXPECT_EQ(supervisor->view(id).runs, 4);
}

TEST_F(StartLimits, AnUnhealthyProcessThatIsAskedToEndStaysDown) {
  runner.script("a", {{.dies_after = 2s}});
  const ProcessId id = supervisor->start(spec("a"));
  supervisor->restart_unhealthy(id);
  supervisor->stop(id);
  loop.advance(10s);
  EXPECT_EQ(supervisor->view(id).runs, 1);
  EXPECT_EQ(supervisor->state(id), ProcessState::kDone);
}

TEST_F(StartLimits, TheHealthIsThatOfARun) {
  supervisor->observe(process_messages(output));
  runner.script("a", {{.exits_after = 5s}});
  ProcessSpec process = spec("a");
  EXPECT_EQ(supervisor->view(supervisor->start(process)).health, Health::kUnwatched);
  process.watches.push_back({.subject = NotBlocked{}});
  const ProcessId id = supervisor->start(process);
  EXPECT_EQ(supervisor->view(id).health, Health::kStarting);
  take_lines();
  supervisor->set_health(id, {Health::kUnhealthy, Health::kStarting, "it sleeps", {}});
  EXPECT_THAT(take_lines(), ElementsAre("0.0 a-2 unhealthy: it sleeps"));
  EXPECT_THAT(screen.text(), testing::HasSubstr("[ERROR] [a-2]: process is unhealthy: it sleeps\n"));
  loop.advance(10s);
  EXPECT_EQ(supervisor->view(id).health, Health::kUnwatched);
}

}  // namespace
}  // namespace launch
