// SPDX-License-Identifier: Apache-2.0
#include "launcher/health/health_monitor.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "launcher/process/fake/fake_event_loop.hpp"
#include "launcher/process/fake/fake_process_runner.hpp"

namespace launch {
namespace {

using namespace std::chrono_literals;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class HealthMonitorTest : public testing::Test {
 protected:
  HealthMonitorTest() {
    supervisor_.observe([this](const ProcessEvent& event) {
      monitor_.on_event(event);
      if (const auto* const change = std::get_if<HealthChanged>(&event.what)) {
        const double seconds = std::chrono::duration<double>(loop_.now()).count();
        journal_.push_back(fmt::format("{:.1f} {} {}{}", seconds, event.label, name_of(change->health),
                                       change->reason.empty() ? "" : ": " + change->reason));
      }
    });
    supervisor_.observe_output([this](const ProcessSpec&, ProcessId id, const std::string&, OutputStream stream,
                                      std::string_view line) { monitor_.on_line(id, stream, line); });
  }

  // A process that must print a line every 5 seconds.
  static ProcessSpec talker(HealthWatch watch = {.subject = OutputLines{}}) {
    ProcessSpec spec;
    spec.name = "talker";
    spec.argv = {"talker"};
    spec.watches = {std::move(watch)};
    return spec;
  }
  static FakeScript prints_at(const std::vector<Duration>& times) {
    FakeScript script;
    for (const Duration at : times) {
      script.output.push_back({.at = at, .text = "hello\n"});
    }
    return script;
  }
  ProcessId start(ProcessSpec spec) {
    const ProcessId id = supervisor_.next_id();
    monitor_.prepare(spec, id);
    return supervisor_.start(std::move(spec));
  }
  std::vector<std::string> journal() { return std::exchange(journal_, {}); }

  FakeEventLoop loop_;
  FakeProcessRunner runner_{loop_};
  OutputRouter output_{[] {
    OutputRouter::Options options;
    options.screen_fd = -1;
    return options;
  }()};
  ProcessSupervisor supervisor_{loop_, runner_, output_};
  std::vector<std::string> journal_;
  HealthMonitor monitor_{loop_,
                         supervisor_,
                         {[this](ProcessId id, const HealthWatch&, const std::string&) {
                            journal_.push_back(fmt::format("act on {}", id));
                          },
                          [this](LogLevel, const std::string& logger, const std::string& text) {
                            journal_.push_back(logger + ": " + text);
                          }}};
};

TEST_F(HealthMonitorTest, FindsAProcessThatFallsSilentAndThatSpeaksAgain) {
  runner_.script("talker", {prints_at({500ms, 4s, 12500ms})});
  const ProcessId id = start(talker());
  EXPECT_EQ(supervisor_.view(id).health, Health::kStarting);
  loop_.advance(2s);
  EXPECT_THAT(journal(), ElementsAre("1.0 talker-1 healthy"));
  loop_.advance(8s);
  EXPECT_THAT(journal(), ElementsAre("9.0 talker-1 unhealthy: it has not printed any line for 5.0 s", "act on 1"));
  EXPECT_EQ(supervisor_.view(id).health_reason, "it has not printed any line for 5.0 s");
  loop_.advance(4s);
  EXPECT_THAT(journal(), ElementsAre("13.0 talker-1 healthy"));
  EXPECT_EQ(supervisor_.view(id).health, Health::kHealthy);
}

TEST_F(HealthMonitorTest, CountsFailuresInARow) {
  runner_.script("talker", {prints_at({})});
  start(talker({.subject = OutputLines{}, .failures = 3}));
  loop_.advance(20s);
  EXPECT_THAT(journal(), ElementsAre("7.0 talker-1 unhealthy: it has not printed any line for 7.0 s", "act on 1"));
}

TEST_F(HealthMonitorTest, FailuresDoNotCountInTheStartPeriod) {
  runner_.script("talker", {prints_at({9500ms})});
  start(talker({.subject = OutputLines{}, .start_period = 10s}));
  loop_.advance(12s);
  EXPECT_THAT(journal(), ElementsAre("10.0 talker-1 healthy"));
  loop_.advance(8s);
  EXPECT_THAT(journal(), ElementsAre(HasSubstr("15.0 talker-1 unhealthy"), "act on 1"));
}

TEST_F(HealthMonitorTest, AFirstSuccessEndsTheStartPeriod) {
  runner_.script("talker", {prints_at({500ms})});
  start(talker({.subject = OutputLines{}, .start_period = 60s}));
  loop_.advance(10s);
  EXPECT_THAT(journal(), ElementsAre("1.0 talker-1 healthy", HasSubstr("6.0 talker-1 unhealthy"), "act on 1"));
}

TEST_F(HealthMonitorTest, ATimeInWhichNobodyLookedDoesNotCount) {
  runner_.script("talker", {prints_at({500ms})});
  start(talker());
  loop_.advance(4s);
  journal();
  loop_.pass(3600s);  // the machine is suspended
  loop_.advance(1s);
  EXPECT_THAT(journal(), ElementsAre(HasSubstr("launch: the health of processes was not looked at for 3599.0 s")));
  loop_.advance(1s);
  EXPECT_THAT(journal(), ElementsAre(HasSubstr("talker-1 unhealthy"), "act on 1"));
}

TEST_F(HealthMonitorTest, AProcessThatWasAskedToEndIsNotJudged) {
  FakeScript slow = prints_at({500ms});
  slow.dies_after = 20s;
  runner_.script("talker", {slow});
  ProcessSpec spec = talker();
  spec.sigterm_timeout = 60s;
  const ProcessId id = start(spec);
  loop_.advance(2s);
  journal();
  supervisor_.stop(id);
  loop_.advance(30s);
  EXPECT_THAT(journal(), IsEmpty());
}

TEST_F(HealthMonitorTest, EachRunBeginsAnew) {
  FakeScript short_run = prints_at({500ms});
  short_run.exits_after = 4s;
  runner_.script("talker", {short_run, prints_at({4500ms})});
  ProcessSpec spec = talker();
  spec.respawn.enabled = true;
  const ProcessId id = start(spec);
  loop_.advance(7s);
  EXPECT_THAT(journal(), ElementsAre("1.0 talker-1 healthy"));
  EXPECT_EQ(supervisor_.view(id).health, Health::kStarting);
  loop_.advance(2s);
  EXPECT_THAT(journal(), ElementsAre("9.0 talker-1 healthy"));
}

TEST_F(HealthMonitorTest, IsUnhealthyByAnyWatchAndHealthyByAll) {
  runner_.script("talker", {prints_at({500ms, 5s, 9s})});
  ProcessSpec spec = talker();
  spec.watches.push_back({.subject = OutputLines{.pattern = "ready"}, .start_period = 30s});
  start(spec);
  loop_.advance(10s);
  EXPECT_THAT(journal(), IsEmpty()) << "one of the two knows nothing yet";
  loop_.advance(10s);
  EXPECT_THAT(journal(), ElementsAre(HasSubstr("14.0 talker-1 unhealthy: it has not printed any line"), "act on 1"));
}

TEST_F(HealthMonitorTest, TheEndOfTheLaunchEndsAllWatches) {
  runner_.script("talker", {prints_at({})});
  start(talker());
  loop_.advance(1s);
  monitor_.shutdown();
  loop_.advance(60s);
  EXPECT_THAT(journal(), IsEmpty());
}

TEST_F(HealthMonitorTest, AThousandProcessesAreLookedAtInOneTurn) {
  runner_.script("talker", {prints_at({500ms, 1500ms, 2500ms, 3500ms, 4500ms})});
  for (int i = 0; i < 1000; ++i) {
    start(talker());
  }
  loop_.advance(2s);
  EXPECT_EQ(journal().size(), 1000U);
}

}  // namespace
}  // namespace launch
