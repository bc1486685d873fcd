// SPDX-License-Identifier: Apache-2.0
// A supervisor and processes of another machine, whose agent is this test.
#include <gmock/gmock.h>
#include <signal.h>

#include <string>
#include <variant>
#include <vector>

#include "base/overloaded.hpp"
#include "launcher/machines/remote_runs.hpp"
#include "launcher/process/fake/fake_event_loop.hpp"
#include "launcher/process/process_runner.hpp"
#include "launcher/process/process_supervisor.hpp"

namespace {

using namespace launch;
using testing::ElementsAre;

class RunsOnly final : public ProcessRunner {
 public:
  explicit RunsOnly(RemoteRuns& runs) : runs_(runs) {}
  Process spawn(const ProcessSpec& spec) override { return runs_.start(spec); }
  void confirm(Process& process) override { runs_.confirm(process); }
  bool signal_group(const Process& process, int signal) override {
    runs_.signal(process, signal);
    return true;
  }
  std::optional<std::uint64_t> limit(const Process&, int, std::uint64_t) override { return std::nullopt; }
  std::vector<bool> groups_live(const std::vector<const Process*>& leaders) override {
    return runs_.groups_live(leaders);
  }
  std::vector<StoppedChild> take_stopped() override { return {}; }
  void await_stop(const Process&) override {}
  bool in_foreground() const override { return true; }
  ProcessExit outcome(const Process& process) override { return runs_.outcome(process); }
  ProcessExit reap(const Process& process) override { return runs_.reap(process); }

 private:
  RemoteRuns& runs_;
};

class SupervisedRuns : public testing::Test {
 protected:
  SupervisedRuns() {
    supervisor.observe([this](const ProcessEvent& event) {
      std::visit(Overloaded{[&](const ProcessStarted&) { events.push_back(event.label + " started"); },
                            [&](const ProcessStartFailed& failed) {
                              events.push_back(event.label + " failed: " + failed.reason);
                            },
                            [&](const ProcessExited& exited) {
                              events.push_back(event.label + (exited.exit.lost ? " lost" : " exited"));
                            },
                            [&](const SignalSent& signalled) {
                              events.push_back(event.label + " got " + std::to_string(signalled.signal));
                            },
                            [&](const ProcessDone&) { events.push_back(event.label + " done"); }, [](const auto&) {}},
                 event.what);
    });
  }

  ProcessSpec spec(const std::string& name) {
    ProcessSpec result;
    result.name = name;
    result.machine = "arm";
    result.argv = {"/bin/" + name};
    return result;
  }
  void say(FromAgent kind, const WireWriter& content) {
    WireReader reader(content.bytes());
    runs.receive(kind, reader);
    loop.run_until_idle();
  }
  void say_started(std::uint32_t run) { say(FromAgent::kStarted, WireWriter().u32(run).i32(4711)); }
  void say_ended(std::uint32_t run, int code) {
    say(FromAgent::kClosed, WireWriter().u32(run).u8(0));
    say(FromAgent::kClosed, WireWriter().u32(run).u8(1));
    WireWriter content;
    content.u32(run);
    put(content, ProcessExit{.code = code});
    say(FromAgent::kExited, content);
  }
  std::vector<ToAgent> asked() const {
    std::vector<ToAgent> kinds;
    for (const auto& [kind, bytes] : sent) {
      kinds.push_back(kind);
    }
    return kinds;
  }

  FakeEventLoop loop;
  std::vector<std::pair<ToAgent, std::string>> sent;
  RemoteRuns runs{loop, [this](ToAgent kind, const WireWriter& content) { sent.emplace_back(kind, content.bytes()); }};
  RunsOnly runner{runs};
  OutputRouter output{OutputRouter::Options{}};
  std::vector<std::string> events;
  ProcessSupervisor supervisor{loop, runner, output};
};

TEST_F(SupervisedRuns, ManyStartsAreAskedForBeforeOneIsAnswered) {
  supervisor.start(spec("one"));
  supervisor.start(spec("two"));
  EXPECT_THAT(asked(), ElementsAre(ToAgent::kStart, ToAgent::kStart));
  EXPECT_TRUE(events.empty());
  EXPECT_EQ(supervisor.state(1), ProcessState::kStarting);
  say_started(2);
  say_started(1);
  EXPECT_THAT(events, ElementsAre("two-2 started", "one-1 started"));
  EXPECT_EQ(supervisor.view(1).pid, 4711);
  say_ended(1, 0);
  EXPECT_THAT(events, ElementsAre("two-2 started", "one-1 started", "one-1 exited", "one-1 done"));
  EXPECT_EQ(asked().back(), ToAgent::kRelease);
}

TEST_F(SupervisedRuns, AnEndThatComesBeforeTheStartWaitsForIt) {
  supervisor.start(spec("one"));
  supervisor.shutdown();
  EXPECT_THAT(asked(), ElementsAre(ToAgent::kStart));
  EXPECT_EQ(supervisor.active(), 1U);
  say_started(1);
  EXPECT_THAT(events, ElementsAre("one-1 started", "one-1 got 2"));
  EXPECT_EQ(asked().back(), ToAgent::kSignal);
  say_ended(1, -SIGINT);
  EXPECT_EQ(supervisor.active(), 0U);
}

TEST_F(SupervisedRuns, AKillThatComesBeforeTheStartWaitsForIt) {
  supervisor.start(spec("one"));
  supervisor.shutdown();
  supervisor.kill_all();
  say_started(1);
  EXPECT_THAT(events, ElementsAre("one-1 started", "one-1 got 2", "one-1 got 9"));
}

TEST_F(SupervisedRuns, AFailedStartIsTriedAgainAsOneHere) {
  ProcessSpec again = spec("one");
  again.respawn.enabled = true;
  supervisor.start(std::move(again));
  say(FromAgent::kFailed, WireWriter().u32(1).i32(ENOENT).text("no program: No such file or directory"));
  EXPECT_THAT(events, ElementsAre("one-1 failed: no program: No such file or directory"));
  loop.advance(ProcessSupervisor::kFailedStartDelay);
  EXPECT_THAT(asked(), ElementsAre(ToAgent::kStart, ToAgent::kStart));
  supervisor.stop(1);
  say(FromAgent::kFailed, WireWriter().u32(2).i32(ENOENT).text("no program: No such file or directory"));
  EXPECT_EQ(events.back(), "one-1 done");
}

TEST_F(SupervisedRuns, ALostMachineIsTheEndOfItsProcesses) {
  ProcessSpec again = spec("one");
  again.respawn.enabled = true;
  supervisor.start(std::move(again));
  supervisor.start(spec("two"));
  say_started(1);
  runs.lose("the connection to machine 'arm' is lost: gone");
  loop.run_until_idle();
  loop.advance(std::chrono::seconds(10));
  EXPECT_THAT(events,
              ElementsAre("one-1 started", "two-2 failed: the connection to machine 'arm' is lost: gone", "two-2 done",
                          "one-1 lost", "one-1 failed: the connection to machine 'arm' is lost: gone", "one-1 done"));
  EXPECT_EQ(supervisor.active(), 0U);
}

}  // namespace
