// SPDX-License-Identifier: Apache-2.0
// The first step of the end: the actions of on_shutdown handlers. Everything still runs meanwhile, and the processes
// that the handlers start have a limited time.
#pragma once

#include <functional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "launcher/process/event_loop.hpp"
#include "launcher/visit/requests.hpp"

namespace launch {

class Farewell {
 public:
  struct Callbacks {
    // Visits a handler, and checks what it asks for (check_farewell()).
    std::function<Requests(const Invocation&)> visit;
    std::function<void(const ProcessCommand&)> execute;
    // Starts a process that runs once. Calls wait_for() before.
    std::function<void(ProcessSpec)> start;
    // Called once, when the requests of the handlers are done or their time is over.
    std::function<void()> over;
    std::function<void(const std::string&)> warn;
  };

  // The loop must outlive this object.
  Farewell(EventLoop& loop, Callbacks callbacks) : loop_(loop), callbacks_(std::move(callbacks)) {}

  // Visits the handlers, each with an OnShutdown, in a turn of the loop of their own. Without handlers the farewell is
  // over at once.
  void say(std::vector<Invocation> handlers);
  void wait_for(ProcessId process) { processes_.insert(process); }
  // The process will not run again.
  void on_done(ProcessId process);
  // Cuts the farewell short.
  void end();

 private:
  void visit_handlers();
  void carry_out(Requests requests);

  EventLoop& loop_;
  Callbacks callbacks_;
  bool under_way_ = false;
  std::vector<Invocation> handlers_;
  std::set<ProcessId> processes_;  // processes that the handlers have started, until they are done
  EventLoop::SourcePtr timer_;
};

}  // namespace launch
