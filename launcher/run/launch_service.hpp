// SPDX-License-Identifier: Apache-2.0
// Runs a launch: visits, begins scopes, starts processes, and ends everything in the opposite order.
//
// Each traversal (the file, later the children of a timer or of an event handler) leaves Requests. They are carried out
// whole or not at all: first every scope begins, then the processes start. When everything has ended, scopes end in
// reverse order. That holds on every path: idle, `shutdown`, on_exit, an error, signals. The end begins with the visit
// of on_shutdown handlers; processes that they start run before the others are asked to end.
//
// This class decides the order of events. Each of its parts does one thing, and reports to the service what follows.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "base/diagnostics/diagnostic.hpp"
#include "launcher/conditions/process_usage_watch.hpp"
#include "launcher/crash/crash_collector.hpp"
#include "launcher/process/event_loop.hpp"
#include "launcher/process/process_supervisor.hpp"
#include "launcher/python/coroutines.hpp"
#include "launcher/ros/ros_tasks.hpp"
#include "launcher/run/end/farewell.hpp"
#include "launcher/run/end/hurry.hpp"
#include "launcher/run/end/outcome.hpp"
#include "launcher/run/end/user_signals.hpp"
#include "launcher/run/handlers/handlers.hpp"
#include "launcher/run/handlers/timers.hpp"
#include "launcher/run/health/health_care.hpp"
#include "launcher/run/limits/limit_care.hpp"
#include "launcher/run/reload/reloads.hpp"
#include "launcher/run/scopes/active_scopes.hpp"
#include "launcher/run/scopes/recording.hpp"
#include "launcher/run/start/processes.hpp"
#include "launcher/run/start/rounds.hpp"
#include "launcher/run/system_test/system_test.hpp"
#include "launcher/run/user/scaling.hpp"
#include "launcher/run/user/steering.hpp"
#include "launcher/visit/launch_context.hpp"

namespace launch {

class Guardian;

class LaunchService {
 public:
  using ErrorSink = std::function<void(const LaunchError&)>;

  // All references must outlive the service. `errors` receives the errors that occur while the launch runs.
  LaunchService(LaunchContext& context, EventLoop& loop, ProcessSupervisor& supervisor, ErrorSink errors);
  ~LaunchService() { supervisor_.observe_output(nullptr); }
  LaunchService(const LaunchService&) = delete;
  LaunchService& operator=(const LaunchService&) = delete;

  // Makes the guardian run the scopes' clean-up commands when the launcher is killed. The launch ends when the guardian
  // is killed. It must outlive the service.
  void use_guardian(Guardian& guardian);

  // Lets a trace hold the steps of the launcher. The recorder must outlive the service.
  void record_to(LaunchRecorder& recorder) { recording_.use_recorder(recorder); }
  // Passes the record to the recorder and to the scopes that want records.
  void record(const LaunchRecord& record) { recording_.record(record); }

  // The client loads components and changes states. Without a client, a launch that asks for either fails. The client
  // must outlive the service.
  void use_ros_client(RosClient& client) {
    context_.use_ros_client(client);
    health_.monitor.use_ros_client(client);
  }

  // Who watches conditions on what nodes do. It must outlive the service.
  void use_condition_watch(ConditionWatch& watch);
  // Called when such a condition begins to hold, and when it holds no longer.
  void observe_conditions(std::function<void(const ConditionEvent&)> observer) { on_condition_ = std::move(observer); }

  // By a source of the loop: the connection to a machine has been lost.
  void on_lost_machine(const LostMachine& lost);
  // By a source of the loop: a connection that was lost is made again.
  void on_returned_machine(const ReturnedMachine& returned);

  // For a test of the system that is launched.
  SystemTest& test() { return test_; }
  // Begins the shutdown in a later turn of the loop.
  void end(const std::string& reason) {
    loop_.post([this, reason] { shutdown(reason); });
  }

  // Failures of processes and components don't change the exit code, as with ros2 launch.
  void ignore_failures() { outcome_.ignore_failures(); }

  // Called before the system stops by Ctrl-Z and after it goes on.
  void observe_suspension(std::function<void(bool stops)> observer) {
    signals_.observe_suspension([this, observer = std::move(observer)](bool stops) {
      handlers_.suspend(stops);
      observer(stops);
    });
  }

  // Called once, when the launch begins to end.
  void observe_end(std::function<void()> observer) { on_end_ = std::move(observer); }

  // Called once: what the file asks for has started, each process after what it depends on.
  void observe_started(std::function<void()> observer) { on_started_ = std::move(observer); }

  // Called when the end does not come, although a second signal has asked for it at once (hurry.hpp). It must end this
  // process.
  void give_up_by(std::function<void()> end) { hurry_.give_up_by(std::move(end)); }

  // Visits the description, runs the loop until nothing is left, and tells what has failed. Returns the exit code
  // (outcome.hpp). SIGINT, SIGTERM, SIGHUP (unless it is ignored) and SIGQUIT shut down. A second signal sends SIGTERM
  // to what is left, a third one SIGKILL. A signal less than a second after another one does not count.
  int run(const LaunchDescription& description);

  // For those who ask the launch from outside.
  Steering& steering() { return steering_; }

  // Changes how many of a process run.
  Scaling& scaling() { return scaling_; }
  // Reads the launch file again while it runs.
  Reloads& reloads() { return reloads_; }
  // From now on SIGHUP reads the launch file again, and does not end the launch. To be called before run().
  void reload_on_hangup() {
    signals_.take_hangup([this] { reloads_.ask({}); });
  }

  // The durations of the steps up to the last start, and of the steps after the last exit, in order.
  const std::vector<TimedStep>& timing() const { return timing_; }

 private:
  // In this order. A launch that ends because nothing is left skips kFarewell and kStopping.
  enum class Phase {
    kRunning,
    kFarewell,      // nothing new starts but the actions of on_shutdown handlers
    kStopping,      // processes have been asked to end
    kEndingScopes,  // no process is left
    kDone
  };

  // Whose requests they are: those of the launch file, also by a timer, can be compared with another reading of it.
  enum class Asker { kFile, kHandler };

  // The events in the course of the launch.
  // Tells whether the guardian has been killed since the last call. It is the process that a user has started, so to
  // kill it is to ask for the end.
  bool on_lost_guardian();
  void on_interrupt(const std::string& signal);
  void on_interrupt_again(int number, const std::string& signal);
  void on_process_event(const ProcessEvent& event);
  void on_end_of_required(const ProcessEvent& event);
  void on_coroutine_step();

  // A traversal: visits, then carries out the requests. An error of the visit carries out nothing and ends the launch.
  void visit(TimerRequest timer);
  void visit(const Invocation& invocation);
  void traverse(const SourceRange& where, Asker asker, const std::function<void()>& traversal);
  void carry_out(Requests requests, Asker asker);
  void start(Round given);
  void observe_output();
  void prepare(ProcessSpec& spec, ProcessId id);

  // The end.
  void fail(const LaunchError& error);
  void shutdown(const std::string& reason);
  // The requests of an on_shutdown handler; none after an error.
  Requests visit_farewell(const Invocation& invocation);
  void stop_processes();
  bool is_idle() const;
  void check_started();
  void check_finished();
  // Checks later, because the code that reports an end may still be at work.
  void post_check();
  void end_scopes();
  void tell_end();

  LaunchContext& context_;
  EventLoop& loop_;
  ProcessSupervisor& supervisor_;
  ErrorSink errors_;
  const Guardian* guardian_ = nullptr;
  bool guardian_missed_ = false;
  std::function<void()> on_started_;
  std::function<void(const ConditionEvent&)> on_condition_;
  bool has_trace_ = false;
  std::function<void()> on_end_;
  std::vector<TimedStep> timing_;

  Phase phase_ = Phase::kRunning;
  bool check_posted_ = false;

  UserSignals signals_;
  Outcome outcome_;
  CrashCollector crashes_;
  HealthCare health_;
  LimitCare limits_;
  ActiveScopes scopes_;
  Rounds rounds_;
  Recording recording_;
  Processes processes_;
  SystemTest test_;
  Steering steering_;
  ProcessUsageWatch process_usage_;
  Handlers handlers_;
  Timers timers_;
  Scaling scaling_;
  Reloads reloads_;
  Coroutines coroutines_;
  RosTasks ros_tasks_;
  Farewell farewell_;
  Hurry hurry_;
};

}  // namespace launch
