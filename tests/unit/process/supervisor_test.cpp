// SPDX-License-Identifier: Apache-2.0
#include <sys/stat.h>

#include <filesystem>

#include "launcher/process/process_supervisor.hpp"
#include "supervisor_fixture.hpp"
#include "temporary_directory.hpp"

namespace launch {
namespace {

using namespace std::chrono_literals;

class Supervisor : public SupervisorFixture {};

TEST_F(Supervisor, NumbersProcessesInTheOrderOfRequests) {
  EXPECT_EQ(supervisor->start(spec("talker")), 1U);
  EXPECT_EQ(supervisor->start(spec("listener")), 2U);
  EXPECT_EQ(supervisor->start(spec("talker")), 3U);
  EXPECT_EQ(lines, (Lines{"0.0 talker-1 started", "0.0 listener-2 started", "0.0 talker-3 started"}));
  EXPECT_EQ(supervisor->active(), 3U);
}

TEST_F(Supervisor, ReportsAnExitWithItsCodeAndDuration) {
  runner.script("a", {{.exits_after = 2s, .exit_code = 3}});
  Duration ran_for{0};
  supervisor->observe([&](const ProcessEvent& event) {
    if (const auto* exited = std::get_if<ProcessExited>(&event.what)) {
      ran_for = exited->exit.ran_for;
    }
  });
  supervisor->start(spec("a"));
  loop.advance(1s);
  EXPECT_EQ(supervisor->state(1), ProcessState::kRunning);
  loop.advance(1s);
  EXPECT_EQ(lines, (Lines{"0.0 a-1 started", "2.0 a-1 exited 3", "2.0 a-1 done"}));
  EXPECT_EQ(ran_for, 2s);
  EXPECT_EQ(supervisor->state(1), ProcessState::kDone);
  EXPECT_EQ(supervisor->active(), 0U);
  EXPECT_EQ(runner.unreaped(), 0U);
}

TEST_F(Supervisor, ReportsAFailedStartAsAnEvent) {
  runner.script("a", {{.spawn_error = ENOENT}});
  EXPECT_EQ(supervisor->start(spec("a")), 1U);
  EXPECT_EQ(lines, (Lines{"0.0 a-1 failed: cannot start '/bin/a': No such file or directory", "0.0 a-1 done"}));
  EXPECT_EQ(supervisor->state(1), ProcessState::kDone);
  EXPECT_EQ(supervisor->active(), 0U);
}

TEST_F(Supervisor, InterruptsAtShutdown) {
  supervisor->start(spec("a"));
  loop.advance(1s);
  supervisor->shutdown();
  EXPECT_EQ(supervisor->state(1), ProcessState::kInterrupting);
  loop.run_until_idle();
  EXPECT_EQ(lines, (Lines{"0.0 a-1 started", "1.0 a-1 SIGINT", "1.0 a-1 exited -2, expected", "1.0 a-1 done"}));
}

TEST_F(Supervisor, EscalatesToSigtermAfterTimeout) {
  runner.script("a", {{.ignores = {SIGINT}}});
  supervisor->start(spec("a"));
  supervisor->shutdown();
  loop.advance(5s - 1ns);
  EXPECT_EQ(runner.signals_of(pid_of_start(0)), (std::vector<int>{SIGINT}));
  take_lines();
  loop.advance(1ns);
  EXPECT_EQ(lines, (Lines{"5.0 a-1 SIGTERM after SIGINT and 5 s", "5.0 a-1 exited -15, expected", "5.0 a-1 done"}));
}

TEST_F(Supervisor, EscalatesToSigkillAfterBothTimeouts) {
  runner.script("a", {{.ignores = {SIGINT, SIGTERM}}});
  ProcessSpec stubborn = spec("a");
  stubborn.sigterm_timeout = 1s;
  stubborn.sigkill_timeout = 500ms;
  supervisor->start(stubborn);
  supervisor->shutdown();
  loop.advance(1499ms);
  EXPECT_EQ(supervisor->state(1), ProcessState::kTerminating);
  loop.advance(1s);
  EXPECT_EQ(lines, (Lines{"0.0 a-1 started", "0.0 a-1 SIGINT", "1.0 a-1 SIGTERM after SIGINT and 1 s",
                          "1.5 a-1 SIGKILL after SIGTERM and 0.5 s", "1.5 a-1 exited -9, expected", "1.5 a-1 done"}));
}

TEST_F(Supervisor, EscalatesAtOnceWithTimeoutsOfZero) {
  runner.script("a", {{.ignores = {SIGINT, SIGTERM}}});
  ProcessSpec stubborn = spec("a");
  stubborn.sigterm_timeout = 0s;
  stubborn.sigkill_timeout = 0s;
  supervisor->start(stubborn);
  supervisor->shutdown();
  loop.run_until_idle();
  EXPECT_EQ(runner.signals_of(pid_of_start(0)), (std::vector<int>{SIGINT, SIGTERM, SIGKILL, SIGKILL}));
  EXPECT_EQ(supervisor->active(), 0U);
}

TEST_F(Supervisor, DoesNotEscalateForAProcessThatExitsDuringTheWait) {
  runner.script("a", {{.dies_after = 4s, .exit_code_on_signal = 0}});
  supervisor->start(spec("a"));
  supervisor->shutdown();
  loop.advance(20s);
  EXPECT_EQ(lines, (Lines{"0.0 a-1 started", "0.0 a-1 SIGINT", "4.0 a-1 exited 0, expected", "4.0 a-1 done"}));
}

TEST_F(Supervisor, ExitDuringTerminationEndsTheEscalation) {
  runner.script("a", {{.ignores = {SIGINT}, .dies_after = 2s}});
  supervisor->start(spec("a"));
  supervisor->shutdown();
  loop.advance(20s);
  EXPECT_EQ(lines.back(), "7.0 a-1 done");
  EXPECT_EQ(runner.signals_of(pid_of_start(0)), (std::vector<int>{SIGINT, SIGTERM, SIGKILL}))
      << "the last one is for descendants, before the process is reaped";
}

TEST_F(Supervisor, ShutdownHasNoEffectTheSecondTime) {
  runner.script("a", {{.ignores = {SIGINT}}});
  supervisor->start(spec("a"));
  supervisor->shutdown();
  loop.advance(4s);
  supervisor->shutdown();
  loop.advance(1s);
  EXPECT_EQ(runner.signals_of(pid_of_start(0)).at(1), SIGTERM) << "the timeout runs from the first call";
}

TEST_F(Supervisor, IgnoresRequestsAfterShutdown) {
  supervisor->shutdown();
  EXPECT_EQ(supervisor->start(spec("a")), 0U);
  EXPECT_TRUE(lines.empty());
  EXPECT_TRUE(runner.spawned().empty());
  EXPECT_EQ(supervisor->active(), 0U);
}

TEST_F(Supervisor, ShutdownLeavesEndedProcessesAlone) {
  runner.script("a", {{.exits_after = 1s}});
  supervisor->start(spec("a"));
  loop.advance(1s);
  take_lines();
  supervisor->shutdown();
  loop.advance(20s);
  EXPECT_TRUE(lines.empty());
  EXPECT_TRUE(runner.signals().empty());
}

TEST_F(Supervisor, InterruptsAProcessThatAnObserverStartedBeforeItShutDown) {
  runner.script("a", {{.exits_after = 1s}});
  supervisor->observe([this](const ProcessEvent& event) {
    if (event.label == "a-1" && std::holds_alternative<ProcessExited>(event.what)) {
      EXPECT_EQ(supervisor->start(spec("b")), 2U);
      EXPECT_EQ(supervisor->state(2), ProcessState::kStarting);
      supervisor->shutdown();
      EXPECT_EQ(supervisor->start(spec("c")), 0U);
    }
  });
  supervisor->start(spec("a"));
  loop.advance(1s);
  EXPECT_EQ(lines, (Lines{"0.0 a-1 started", "1.0 a-1 exited 0", "1.0 a-1 done", "1.0 b-2 started", "1.0 b-2 SIGINT",
                          "1.0 b-2 exited -2, expected", "1.0 b-2 done"}));
}

TEST_F(Supervisor, TerminateAllIsForProcessesThatHaveOnlyGotSigint) {
  runner.default_script({.ignores = {SIGINT, SIGTERM}});
  ProcessSpec slow = spec("a");
  slow.sigterm_timeout = 1s;
  slow.sigkill_timeout = 7s;
  supervisor->start(slow);
  supervisor->start(spec("b"));
  supervisor->shutdown();
  loop.advance(2s);
  EXPECT_EQ(supervisor->alive(), (Lines{"a-1", "b-2"}));
  lines.clear();
  EXPECT_EQ(supervisor->terminate_all(), 7s);
  EXPECT_EQ(lines, (Lines{"2.0 b-2 SIGTERM"}));
  loop.advance(20s);
  EXPECT_EQ(lines, (Lines{"2.0 b-2 SIGTERM", "7.0 b-2 SIGKILL after SIGTERM and 5 s", "7.0 b-2 exited -9, expected",
                          "7.0 b-2 done", "8.0 a-1 SIGKILL after SIGTERM and 7 s", "8.0 a-1 exited -9, expected",
                          "8.0 a-1 done"}));
  EXPECT_TRUE(supervisor->alive().empty());
}

TEST_F(Supervisor, KillAllEndsWhateverRunsInAnyState) {
  runner.default_script({.ignores = {SIGINT, SIGTERM}});
  supervisor->start(spec("a"));
  supervisor->kill_all();
  loop.run_until_idle();
  EXPECT_EQ(lines, (Lines{"0.0 a-1 started", "0.0 a-1 SIGKILL", "0.0 a-1 exited -9, expected", "0.0 a-1 done"}));

  ProcessSpec slow = spec("b");
  slow.sigterm_timeout = 1s;
  supervisor->start(slow);
  supervisor->start(spec("c"));
  supervisor->shutdown();
  loop.advance(2s);
  EXPECT_EQ(supervisor->state(2), ProcessState::kTerminating);
  EXPECT_EQ(supervisor->state(3), ProcessState::kInterrupting);
  supervisor->kill_all();
  loop.run_until_idle();
  EXPECT_EQ(supervisor->active(), 0U);
  loop.advance(20s);
  EXPECT_EQ(lines.back(), "2.0 c-3 done") << "no timer is left";
}

TEST_F(Supervisor, SendsARequestedSignalWithoutEscalation) {
  runner.script("a", {{.ignores = {SIGINT}}});
  supervisor->start(spec("a"));
  supervisor->signal(1, SIGINT);
  loop.advance(60s);
  EXPECT_EQ(lines, (Lines{"0.0 a-1 started", "0.0 a-1 SIGINT"}));
  supervisor->signal(1, SIGTERM);
  loop.run_until_idle();
  EXPECT_EQ(lines.back(), "60.0 a-1 done");
  supervisor->signal(1, SIGTERM);
  EXPECT_EQ(lines.back(), "60.0 a-1 done") << "nothing is sent to a process that has ended";
}

TEST_F(Supervisor, DoesNotExpectAnExitAfterAHarmlessSignal) {
  runner.script("a", {{.exits_after = 1s, .exit_code = 1}});
  supervisor->start(spec("a"));
  supervisor->signal(1, SIGUSR1);
  loop.advance(1s);
  EXPECT_EQ(lines, (Lines{"0.0 a-1 started", "0.0 a-1 SIGUSR1", "1.0 a-1 exited 1", "1.0 a-1 done"}));
}

TEST_F(Supervisor, TellsAllObserversInOrderAlsoAboutEventsThatTheyCause) {
  Lines second;
  supervisor->observe([this](const ProcessEvent& event) {
    if (std::holds_alternative<ProcessStarted>(event.what)) {
      supervisor->signal(event.id, SIGTERM);
    }
  });
  supervisor->observe([&](const ProcessEvent& event) { EventText(loop, second)(event); });
  supervisor->start(spec("a"));
  loop.run_until_idle();
  EXPECT_EQ(second, lines);
  EXPECT_EQ(second, (Lines{"0.0 a-1 started", "0.0 a-1 SIGTERM", "0.0 a-1 exited -15, expected", "0.0 a-1 done"}));
}

TEST_F(Supervisor, ShowsOutputBeforeTheExit) {
  runner.script("a", {{.exits_after = 1s, .output = {{.at = 1s, .text = "last words\nunfinished"}}}});
  std::string at_exit;
  supervisor->observe([&](const ProcessEvent& event) {
    if (std::holds_alternative<ProcessExited>(event.what)) {
      at_exit = screen.text();
    }
  });
  supervisor->start(spec("a"));
  loop.advance(1s);
  EXPECT_EQ(at_exit, "[a-1] last words\n[a-1] unfinished\n");
}

TEST_F(Supervisor, KillsWhatIsAliveWhenItIsDestroyed) {
  runner.default_script({.ignores = {SIGINT, SIGTERM}});
  supervisor->start(spec("a"));
  supervisor->start(spec("b"));
  supervisor.reset();
  EXPECT_EQ(runner.signals_of(pid_of_start(0)), (std::vector<int>{SIGKILL}));
  EXPECT_EQ(runner.signals_of(pid_of_start(1)), (std::vector<int>{SIGKILL}));
  EXPECT_EQ(runner.unreaped(), 0U);
}

TEST_F(Supervisor, ServesAThousandProcesses) {
  constexpr std::size_t kCount = 1000;
  runner.script("stubborn", {{.ignores = {SIGINT}}});
  ASSERT_TRUE(make_posix_process_runner()) << "raises the limit of open descriptors";
  for (std::size_t i = 0; i < kCount; ++i) {
    supervisor->start(spec(i % 2 == 0 ? "quick" : "stubborn"));
  }
  EXPECT_EQ(supervisor->active(), kCount);
  supervisor->shutdown();
  loop.run_until_idle();
  EXPECT_EQ(supervisor->active(), kCount / 2);
  loop.advance(5s);
  EXPECT_EQ(supervisor->active(), 0U);
  EXPECT_EQ(runner.unreaped(), 0U);
}

TEST_F(Supervisor, WritesGeneratedFilesForTheUserAloneAndRemovesThem) {
  ProcessSpec with_files = spec("a");
  with_files.argv = {"/bin/a", "--params-file", "?", "--params-file", "?"};
  with_files.files = {{2, "a/params.yaml", "x: 1\n"}, {4, "a/params.yaml", "x: 2\n"}};
  supervisor->start(with_files);
  const std::vector<std::string> argv = runner.spawned().at(0).spec.argv;
  EXPECT_EQ(TemporaryDirectory::read_file(argv.at(2)), "x: 1\n");
  EXPECT_EQ(TemporaryDirectory::read_file(argv.at(4)), "x: 2\n");
  const std::filesystem::path directory = std::filesystem::path(argv.at(2)).parent_path();
  struct stat status {};
  ASSERT_EQ(::stat(directory.c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777U, 0700U);
  supervisor.reset();
  EXPECT_FALSE(std::filesystem::exists(directory));
}

TEST_F(Supervisor, ReportsGeneratedFilesThatCannotBeWrittenAsAFailedStart) {
  ProcessSpec with_files = spec("a");
  with_files.argv = {"/bin/a", "?"};
  with_files.files = {{1, std::string(300, 'n'), ""}};
  supervisor->start(with_files);
  ASSERT_EQ(lines.size(), 2U);
  EXPECT_NE(lines[0].find("File name too long"), std::string::npos) << lines[0];
  EXPECT_TRUE(runner.spawned().empty());
}

TEST_F(Supervisor, GivesUpAProcessOfAnotherUserAfterSigkill) {
  runner.script("a", {{.refuses_signals = true}});
  supervisor->start(spec("a"));
  supervisor->shutdown();
  loop.advance(60s);
  EXPECT_EQ(lines, (Lines{"0.0 a-1 started", "0.0 a-1 SIGINT", "5.0 a-1 SIGTERM after SIGINT and 5 s",
                          "10.0 a-1 SIGKILL after SIGTERM and 5 s", "10.0 a-1 left, foreign", "10.0 a-1 done"}));
  EXPECT_EQ(supervisor->active(), 0U);
}

}  // namespace
}  // namespace launch
