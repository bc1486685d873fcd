// SPDX-License-Identifier: Apache-2.0
// A ProcessRunner for tests: processes that follow a script, on the virtual time of a FakeEventLoop.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "launcher/process/fake/fake_event_loop.hpp"
#include "launcher/process/process_runner.hpp"

namespace launch {

// One run of a process. By default it runs until it is signalled and dies of the first SIGINT, SIGTERM or SIGKILL.
struct FakeScript {
  struct Output {
    Duration at{0};  // after the start
    std::string text{};
    bool to_err = false;
  };

  std::optional<Duration> exits_after{};     // by itself
  int exit_code = 0;                         // then; -N: killed by signal N
  std::set<int> ignores{};                   // signals without effect (not SIGKILL)
  Duration dies_after{0};                    // time from a deadly signal to the exit
  std::optional<int> exit_code_on_signal{};  // for a process that handles signals; else it dies of the signal
  std::vector<Output> output{};
  // Descendants hold its output open after its exit, for this long or until SIGKILL. They ignore `ignores` as well.
  std::optional<Duration> descendants_for{};
  // They leave the group so long after the exit, and get no signals from then on.
  std::optional<Duration> descendants_leave_after{};
  Duration start_takes{0};           // of the launcher
  std::optional<int> spawn_error{};  // errno of a start that fails
  bool refuses_signals = false;      // it belongs to another user
  bool lacks_terminal = false;       // the launcher has none, although the spec asks for it
};

// Records the requests that it gets. The processes are not real, so their pids (from 1,000,001 on) must not be
// signalled.
class FakeProcessRunner final : public ProcessRunner {
 public:
  struct Spawned {
    ProcessSpec spec;
    pid_t pid;  // -1: failed
    Duration at;
  };
  struct Signalled {
    pid_t pid;
    int signal;
    Duration at;
  };

  struct Limited {
    pid_t pid;
    int resource;
    std::uint64_t soft;
    Duration at;
  };
  static constexpr std::uint64_t kSoftLimit = 1'000'000;  // before the first limit() of a process

  explicit FakeProcessRunner(FakeEventLoop& loop);
  ~FakeProcessRunner() override;

  // The runs of processes with this ProcessSpec::name, one after the other; the last script serves all later runs.
  void script(const std::string& name, std::vector<FakeScript> runs);
  // For all names without a script.
  void default_script(FakeScript run);

  Process spawn(const ProcessSpec& spec) override;
  bool signal_group(const Process& process, int signal) override;
  std::optional<std::uint64_t> limit(const Process& process, int resource, std::uint64_t soft) override;
  std::vector<bool> groups_live(const std::vector<const Process*>& leaders) override;
  std::vector<StoppedChild> take_stopped() override { return std::exchange(stopped_, {}); }
  void await_stop(const Process& process) override { awaited_stops_.push_back(process.pid); }
  bool in_foreground() const override { return foreground_; }
  ProcessExit outcome(const Process& process) override;
  ProcessExit reap(const Process& process) override;

  void put_into_background(bool background) { foreground_ = !background; }
  // From now on take_stopped() tells of it.
  void stop(pid_t pid, int signal) { stopped_.push_back({pid, signal}); }

  const std::vector<Spawned>& spawned() const { return spawned_; }
  const std::vector<Signalled>& signals() const { return signals_; }
  const std::vector<Limited>& limits() const { return limits_; }
  // The processes of which await_stop() has been called.
  const std::vector<pid_t>& awaited_stops() const { return awaited_stops_; }
  std::vector<int> signals_of(pid_t pid) const;
  // What a process that is not yet reaped has got on its standard input since the last call.
  std::string take_input(pid_t pid);
  // Started and not yet reaped.
  std::size_t unreaped() const;

 private:
  struct Running;

  const FakeScript& next_script(const std::string& name);
  Running& find(const Process& process) const;
  void exit(Running& process, int code);

  FakeEventLoop& loop_;
  FakeScript default_;
  std::map<std::string, std::vector<FakeScript>> scripts_;
  std::map<std::string, std::size_t> runs_;
  std::map<pid_t, std::unique_ptr<Running>> running_;
  pid_t last_pid_ = 1'000'000;
  std::vector<Spawned> spawned_;
  std::vector<Signalled> signals_;
  std::vector<Limited> limits_;
  std::vector<StoppedChild> stopped_;
  std::vector<pid_t> awaited_stops_;
  bool foreground_ = true;
};

}  // namespace launch
