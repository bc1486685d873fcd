// Runs a launch: visits, begins scopes, starts processes, ends everything in the opposite order.
//
// Each traversal (the file, later the children of a timer) leaves Requests. They are carried out whole or not at all:
// first every scope begins, then the processes start. When everything has ended, scopes end in reverse order. That
// holds on every path: idle, `shutdown`, on_exit, an error, signals.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <list>
#include <map>
#include <memory>
#include <vector>

#include "launcher/base/diagnostic.hpp"
#include "launcher/core/launch_context.hpp"
#include "launcher/core/ros_tasks.hpp"
#include "launcher/process/event_loop.hpp"
#include "launcher/process/guardian/guardian.hpp"
#include "launcher/process/process_supervisor.hpp"

namespace launch {

class LaunchService {
 public:
  using ErrorSink = std::function<void(const LaunchError&)>;

  // All references must outlive the service. `errors` receives what goes wrong while the launch runs.
  LaunchService(LaunchContext& context, EventLoop& loop, ProcessSupervisor& supervisor, ErrorSink errors);

  // Has the scopes' clean-up commands run should the launcher be killed. The guardian must outlive the service.
  void guard_scopes(Guardian& guardian) { guardian_ = &guardian; }

  // Who loads components and changes states. Without a client a launch that asks for either fails. It must outlive the
  // service.
  void use_ros_client(RosClient& client);

  // Visits the description and runs the loop until nothing is left. Returns the exit code: 0, or 1 after an error of
  // the launch itself, a process that could not be started included. How processes ended doesn't count.
  // SIGINT, SIGTERM, SIGHUP and SIGQUIT shut down; a second one kills what is left and ends at once.
  int run(const LaunchDescription& description);

  // How long the steps up to the last start took, in order.
  const std::vector<TimedStep>& timing() const { return timing_; }

 private:
  struct Timer {
    TimerRequest request;
    EventLoop::SourcePtr source;
  };

  void on_signal(int signal);
  void on_process_event(const ProcessEvent& event);
  void on_timer(std::list<Timer>::iterator timer);

  void carry_out(Requests requests);
  void begin_next();
  void on_begun(std::exception_ptr error);
  void start(Requests requests);
  void start_ros_tasks(Requests& requests);
  void fail(const LaunchError& error);
  void shutdown();
  void check_finished();
  void post_check();
  void end_next_scope();
  void guard(const RunScope& scope);
  void unguard(const RunScope& scope);
  RunScope::Tell teller();

  LaunchContext& context_;
  EventLoop& loop_;
  ProcessSupervisor& supervisor_;
  ErrorSink errors_;
  Guardian* guardian_ = nullptr;
  std::unique_ptr<RosTasks> ros_tasks_;                // null without a client
  std::map<const RunScope*, std::int32_t> clean_ups_;  // their numbers at the guardian

  std::deque<Requests> waiting_;  // the first one may be beginning its scopes
  std::size_t next_scope_ = 0;    // of waiting_.front()
  bool scope_is_beginning_ = false;
  std::vector<std::unique_ptr<RunScope>> active_scopes_;
  std::list<Timer> timers_;
  bool shutting_down_ = false;
  bool ending_ = false;
  bool check_posted_ = false;
  int signals_ = 0;
  int exit_code_ = 0;
  std::vector<TimedStep> timing_;
};

}  // namespace launch
