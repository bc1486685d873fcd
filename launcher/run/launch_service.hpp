// SPDX-License-Identifier: Apache-2.0
// Runs a launch: visits, begins scopes, starts processes, ends everything in the opposite order.
//
// Each traversal (the file, later the children of a timer or of an event handler) leaves Requests. They are carried out
// whole or not at all: first every scope begins, then the processes start. When everything has ended, scopes end in
// reverse order. That holds on every path: idle, `shutdown`, on_exit, an error, signals. The first thing of the end is
// to visit what `on_shutdown` handlers hold; processes that they start run before the others are asked to end.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <list>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "launcher/base/diagnostic.hpp"
#include "launcher/process/event_loop.hpp"
#include "launcher/process/guardian/guardian.hpp"
#include "launcher/process/process_supervisor.hpp"
#include "launcher/python/coroutines.hpp"
#include "launcher/ros/ros_tasks.hpp"
#include "launcher/run/event_handlers.hpp"
#include "launcher/run/start_order.hpp"
#include "launcher/run/state_handlers.hpp"
#include "launcher/visit/launch_context.hpp"
#include "launcher/visit/process_table.hpp"

namespace launch {

class LaunchService {
 public:
  using ErrorSink = std::function<void(const LaunchError&)>;

  // All references must outlive the service. `errors` receives what goes wrong while the launch runs.
  LaunchService(LaunchContext& context, EventLoop& loop, ProcessSupervisor& supervisor, ErrorSink errors);
  ~LaunchService();
  LaunchService(const LaunchService&) = delete;
  LaunchService& operator=(const LaunchService&) = delete;

  // Has the scopes' clean-up commands run should the launcher be killed. The guardian must outlive the service.
  void guard_scopes(Guardian& guardian) { guardian_ = &guardian; }

  // Has a trace tell what the launcher does. The recorder must outlive the service.
  void record_to(LaunchRecorder& recorder) { recorder_ = &recorder; }
  // Tells the recorder and the scopes that want to know.
  void record(const LaunchRecord& record);

  // Who loads components and changes states. Without a client a launch that asks for either fails. It must outlive the
  // service.
  void use_ros_client(RosClient& client);

  // Visits the description and runs the loop until nothing is left. Returns the exit code: 0, or 1 after an error of
  // the launch itself, a process that could not be started included, else that of the `required` process that has ended
  // the launch, 128+N when signal N ended it. How other processes ended doesn't count.
  // SIGINT, SIGTERM, SIGHUP and SIGQUIT shut down; a second one kills what is left and ends at once.
  int run(const LaunchDescription& description);

  // How long the steps up to the last start and those after the last exit took, in order.
  const std::vector<TimedStep>& timing() const { return timing_; }

 private:
  struct Timer {
    TimerRequest request;
    EventLoop::SourcePtr source;
  };

  // What one traversal asked for, and the processes of it.
  struct Round {
    Requests requests;
    std::vector<TrackedProcess*> processes;
  };

  void on_signal(int signal);
  void on_process_event(const ProcessEvent& event);
  void on_line(const ProcessSpec& spec, ProcessId id, const std::string& label, OutputStream stream,
               std::string_view line);
  void on_timer(std::list<Timer>::iterator timer);

  // Visits actions in a scope of their own and carries out what they ask for.
  void visit(Scope scope, const std::vector<ActionPtr>& actions);
  void invoke(std::vector<Invocation> invocations);
  void run_invocations();

  void carry_out(Requests requests);
  void begin_next();
  void on_begun(std::exception_ptr error);
  void start(Round round);
  void start_process(ProcessSpec spec, TrackedProcess& process);
  void start_timer(TimerRequest request);
  void start_ros_tasks(Requests& requests);
  // Coroutines have run up to where they wait.
  void on_step();
  void register_handler(EventHandler handler);
  void unregister_handlers(const UnregisterRequest& request);
  // Visits a handler once its condition holds.
  void wait_for(EventHandler handler);
  void execute(const ProcessCommand& command);
  void fail(const LaunchError& error);
  void shutdown(const std::string& reason);
  void say_farewell();
  void visit_farewell(const Invocation& invocation);
  void end_farewell();
  void check_finished();
  void post_check();
  void end_next_scope();
  void append_timing(const RunScope& scope);
  void guard(RunScope& scope);
  void unguard(const RunScope& scope);
  RunScope::Tell teller();
  void record(const ProcessEvent& event);
  void record_visit(std::int64_t begin, const SourceRange& where, Requests& requests);
  void begin_recording();

  LaunchContext& context_;
  EventLoop& loop_;
  ProcessSupervisor& supervisor_;
  ErrorSink errors_;
  Guardian* guardian_ = nullptr;
  LaunchRecorder* recorder_ = nullptr;
  bool recording_ = false;
  std::unique_ptr<RosTasks> ros_tasks_;                // null without a client
  std::map<const RunScope*, std::int32_t> clean_ups_;  // their numbers at the guardian

  ProcessTable table_;
  EventHandlers handlers_;
  StateHandlers state_handlers_;
  std::list<std::shared_ptr<const EventHandler>> waits_;  // those for conditions
  Coroutines coroutines_;
  StartOrder start_order_;
  std::deque<std::vector<Invocation>> events_;  // whose handlers are to be visited; each has a post of its own
  bool output_observed_ = false;

  std::deque<Round> waiting_;   // the first one may be beginning its scopes
  std::size_t next_scope_ = 0;  // of waiting_.front()
  bool scope_is_beginning_ = false;
  std::vector<std::unique_ptr<RunScope>> active_scopes_;
  std::list<Timer> timers_;
  bool shutting_down_ = false;
  std::vector<Invocation> last_invocations_;  // of on_shutdown
  std::set<ProcessId> last_processes_;        // that they have started, until they are done
  EventLoop::SourcePtr farewell_timer_;
  bool farewell_ = false;  // what on_shutdown handlers ask for is under way
  bool ending_ = false;
  bool check_posted_ = false;
  int signals_ = 0;
  int exit_code_ = 0;
  std::vector<TimedStep> timing_;
  Duration last_exit_{0};  // by the loop's clock; everything has ended
};

}  // namespace launch
