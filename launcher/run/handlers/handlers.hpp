// SPDX-License-Identifier: Apache-2.0
// Everything to which a launch reacts: its event handlers of all kinds, and the visits that wait.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "base/diagnostics/diagnostic.hpp"
#include "launcher/process/event_loop.hpp"
#include "launcher/process/process_event.hpp"
#include "launcher/ros/ros_client.hpp"
#include "launcher/run/handlers/condition_handlers.hpp"
#include "launcher/run/handlers/event_handlers.hpp"
#include "launcher/run/handlers/invocation_queue.hpp"
#include "launcher/run/handlers/ready_handlers.hpp"
#include "launcher/run/handlers/state_handlers.hpp"
#include "launcher/visit/requests.hpp"

namespace launch {

class Handlers {
 public:
  // `visit` and `visited` are as in InvocationQueue. `fail` gets an error that prevents a handler from getting its
  // event. The loop must outlive this object.
  Handlers(EventLoop& loop, std::function<void(const Invocation&)> visit, std::function<void()> visited,
           const std::function<void(const LaunchError&)>& fail);

  // As ConditionHandlers::use().
  void use_condition_watches(ConditionWatch& recorded, ConditionWatch& processes,
                             ConditionHandlers::Callbacks callbacks) {
    live_.use(recorded, processes, std::move(callbacks));
  }

  // The client watches the states of nodes; it may be null when no handler needs them.
  void add(EventHandler handler, RosClient* client);
  // Forgets the handlers of these names, also for events that wait for their visit. Warns when there is none.
  void unregister(const std::vector<UnregisterRequest>& requests,
                  const std::function<void(const std::string& text)>& warn);

  // Forgets all handlers.
  void clear();

  void on_event(const ProcessEvent& event) { queue_.add(events_.on_event(event)); }
  void on_line(const ProcessSpec& spec, const std::string& label, OutputStream stream, std::string_view line) {
    queue_.add(events_.on_line(spec, label, stream, line));
  }
  void on_lost_machine(const LostMachine& lost) { queue_.add(events_.on_lost_machine(lost)); }
  void on_returned_machine(const ReturnedMachine& returned) { queue_.add(events_.on_returned_machine(returned)); }
  // Ends all watches outside the launch. Returns the handlers of the shutdown, which are not in the queue.
  std::vector<Invocation> shutdown(const std::string& reason);

  // As ConditionHandlers::suspend().
  void suspend(bool stops) { live_.suspend(stops); }

  bool has_on_shutdown() const { return events_.has_on_shutdown(); }
  // Whether some handler wants lines.
  bool watch_output() const { return events_.watch_output(); }
  // Whether no event waits for the visit of its handlers.
  bool idle() const { return queue_.empty(); }

 private:
  bool remove(const std::string& name);

  InvocationQueue queue_;
  EventHandlers events_;
  StateHandlers states_;
  ReadyHandlers conditions_;
  ConditionHandlers live_;
};

}  // namespace launch
