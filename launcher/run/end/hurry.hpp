// SPDX-License-Identifier: Apache-2.0
// What a second and a third signal do: the end that has begun goes on faster.
//
// - The farewell is cut short.
// - Then each signal takes what still runs a step further: SIGTERM, SIGKILL.
// - When nothing runs, traces and crash bundles end at once, with the data that is there. The launch gives up on a
// trace
//   that does not answer.
#pragma once

#include <functional>
#include <string>
#include <utility>

#include "launcher/crash/crash_collector.hpp"
#include "launcher/process/event_loop.hpp"
#include "launcher/process/output/output_router.hpp"
#include "launcher/process/process_supervisor.hpp"
#include "launcher/run/end/farewell.hpp"
#include "launcher/run/scopes/active_scopes.hpp"

namespace launch {

class Hurry {
 public:
  // How long a trace has to begin or to end: a session daemon that does not answer can block it for ever.
  static constexpr Duration kPatience = std::chrono::seconds(5);

  using Tell = std::function<void(LogLevel level, const std::string& text)>;

  // The references must outlive this object.
  Hurry(EventLoop& loop, ProcessSupervisor& supervisor, ActiveScopes& scopes, CrashCollector& crashes,
        Farewell& farewell, Tell tell)
      : loop_(loop),
        supervisor_(supervisor),
        scopes_(scopes),
        crashes_(crashes),
        farewell_(farewell),
        tell_(std::move(tell)) {}

  // `end` is called when the launch gives up. It must end this process. Without it, the launch waits on.
  void give_up_by(std::function<void()> end) { give_up_ = std::move(end); }

  // A further signal has come, such as "ctrl-c (SIGINT)". `in_farewell`: actions of on_shutdown handlers are under way.
  void on_signal(const std::string& signal, bool in_farewell);

 private:
  void end_scopes_at_once();
  void watch();

  EventLoop& loop_;
  ProcessSupervisor& supervisor_;
  ActiveScopes& scopes_;
  CrashCollector& crashes_;
  Farewell& farewell_;
  Tell tell_;
  std::function<void()> give_up_;
  EventLoop::SourcePtr timer_;
  bool terminated_ = false;  // SIGTERM has been sent
};

}  // namespace launch
