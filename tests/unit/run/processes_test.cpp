// SPDX-License-Identifier: Apache-2.0
#include "launcher/run/start/processes.hpp"

#include <gmock/gmock.h>
#include <signal.h>

#include <optional>

#include "launcher/process/fake/fake_event_loop.hpp"
#include "launcher/process/fake/fake_process_runner.hpp"

namespace launch {
namespace {

using namespace std::chrono_literals;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class ProcessesTest : public testing::Test {
 protected:
  ProcessesTest() {
    supervisor_.observe([this](const ProcessEvent& event) { processes_.on_event(event); });
  }

  static ProcessSpec spec(const std::string& name) {
    ProcessSpec spec;
    spec.name = name;
    spec.argv = {name};
    return spec;
  }
  static Requests requests(const std::vector<std::string>& names) {
    Requests requests;
    for (const std::string& name : names) {
      requests.processes.push_back(spec(name));
    }
    return requests;
  }
  static Dependency until_exited(std::size_t process, const std::string& other) {
    Dependency dependency;
    dependency.process = process;
    dependency.condition = ProcessCondition{other, UntilExited{}};
    return dependency;
  }
  void start(Requests given) {
    Round round = processes_.enter(std::move(given));
    processes_.wait(round);
    round_.emplace(std::move(round));
    processes_.start(*round_, [this] { started_ = true; });
  }
  std::vector<std::string> spawned() const {
    std::vector<std::string> names;
    for (const FakeProcessRunner::Spawned& each : runner_.spawned()) {
      names.push_back(each.spec.name);
    }
    return names;
  }

  std::optional<Round> round_;
  bool started_ = false;
  FakeEventLoop loop_;
  FakeProcessRunner runner_{loop_};
  OutputRouter output_{[] {
    OutputRouter::Options options;
    options.screen_fd = -1;
    return options;
  }()};
  ProcessSupervisor supervisor_{loop_, runner_, output_};
  std::vector<std::string> journal_;
  Processes processes_{
      loop_,
      supervisor_,
      {[this](ProcessSpec& starting, ProcessId id) { journal_.push_back(starting.name + std::to_string(id)); },
       [this](const LaunchError& error) { journal_.emplace_back(error.what()); },
       [this](LogLevel, const std::string& logger, const std::string& text) {
         journal_.push_back(logger + ": " + text);
       },
       [this](const TrackedProcess& process) { journal_.push_back("skipped " + process.names.front()); },
       [this](const std::string& process, const Dependency& dependency) {
         journal_.push_back(process + ": " + describe(dependency));
       }}};
};

TEST_F(ProcessesTest, AProcessThatWaitsStartsAfterTheOther) {
  runner_.default_script({.exits_after = 1s});
  Requests given = requests({"late", "early"});
  given.dependencies.push_back(until_exited(0, "early"));
  start(std::move(given));
  EXPECT_THAT(spawned(), ElementsAre("early"));
  EXPECT_TRUE(processes_.waiting());
  loop_.advance(2s);
  EXPECT_THAT(spawned(), ElementsAre("early", "late"));
  EXPECT_FALSE(processes_.waiting());
  EXPECT_THAT(journal_,
              ElementsAre(HasSubstr("late: waits until"), "early1", HasSubstr("late: 'early' has exited"), "late2"));
}

TEST_F(ProcessesTest, ANameThatNoProcessHasIsAnErrorBeforeAnythingStarts) {
  Requests given = requests({"a"});
  given.dependencies.push_back(until_exited(0, "nobody"));
  EXPECT_THROW(processes_.enter(std::move(given)), LaunchError);
  EXPECT_THROW(processes_.check({{.process = "nobody"}}), LaunchError);
  EXPECT_THAT(spawned(), IsEmpty());
}

TEST_F(ProcessesTest, AfterTheShutdownOnlyTheLastOnesStart) {
  Requests given = requests({"late", "early"});
  given.dependencies.push_back(until_exited(0, "early"));
  Round round = processes_.enter(std::move(given));
  processes_.wait(round);
  processes_.shutdown();
  processes_.start(round, [this] { started_ = true; });
  EXPECT_TRUE(started_);
  EXPECT_FALSE(processes_.waiting());
  ProcessSpec last = spec("last");
  last.respawn.enabled = last.required = true;
  processes_.start_last(std::move(last));
  ASSERT_THAT(spawned(), ElementsAre("last"));
  EXPECT_FALSE(runner_.spawned().front().spec.respawn.enabled);
  EXPECT_FALSE(runner_.spawned().front().spec.required);
}

TEST_F(ProcessesTest, ALargeRoundStartsInSlices) {
  runner_.default_script({.start_takes = 3ms});
  runner_.script("first", {{.exits_after = 1ms, .start_takes = 3ms}});
  Requests given = requests({"late", "first", "a", "b", "c", "dropped", "d", "e"});
  given.dependencies.push_back(until_exited(0, "first"));
  start(std::move(given));
  EXPECT_THAT(spawned(), ElementsAre("first", "a", "b", "c")) << "after 10 ms it is the turn of others";
  EXPECT_FALSE(started_);
  processes_.execute({.kind = ProcessCommand::Kind::kStop, .process = "dropped"});
  std::vector<std::string> waiting;
  processes_.for_each([&](const TrackedProcess& process, const ProcessSpec* spec) {
    if (spec != nullptr) {
      waiting.push_back(process.names.front());
    }
  });
  EXPECT_THAT(waiting, ElementsAre("late", "d", "e"));
  loop_.run_until_idle();
  EXPECT_TRUE(started_);
  EXPECT_THAT(spawned(), ElementsAre("first", "a", "b", "c", "d", "e", "late"))
      << "what waits for another one comes behind its round";
  EXPECT_THAT(journal_, testing::Contains("skipped dropped"));
}

TEST_F(ProcessesTest, AShutdownEndsTheStartOfALargeRound) {
  runner_.default_script({.start_takes = 6ms});
  start(requests({"a", "b", "c", "d"}));
  EXPECT_THAT(spawned(), ElementsAre("a", "b"));
  processes_.shutdown();
  loop_.run_until_idle();
  EXPECT_TRUE(started_);
  EXPECT_THAT(spawned(), ElementsAre("a", "b"));
}

TEST_F(ProcessesTest, ACommandGoesToEveryProcessOfTheName) {
  start(requests({"a", "b", "a"}));
  processes_.execute({.kind = ProcessCommand::Kind::kSignal, .process = "a", .signal = SIGUSR1});
  std::vector<pid_t> signalled;
  for (const FakeProcessRunner::Signalled& each : runner_.signals()) {
    signalled.push_back(each.pid - 1'000'000);
  }
  EXPECT_THAT(signalled, ElementsAre(1, 3));
}

TEST_F(ProcessesTest, ACommandToAProcessThatHasEndedIsToldUnlessItRestarts) {
  runner_.script("a", {{.exits_after = 1s}, {}});
  start(requests({"a"}));
  loop_.advance(2s);
  journal_.clear();
  processes_.execute({.kind = ProcessCommand::Kind::kStop, .process = "a"});
  EXPECT_THAT(journal_, ElementsAre(HasSubstr("launch: stop: process 'a' does not run")));
  processes_.execute({.kind = ProcessCommand::Kind::kRestart, .process = "a"});
  EXPECT_THAT(spawned(), ElementsAre("a", "a"));
}

}  // namespace
}  // namespace launch
