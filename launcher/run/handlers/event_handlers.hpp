// SPDX-License-Identifier: Apache-2.0
// The registered event handlers, and the choice of those that an event concerns.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "launcher/visit/event_handler.hpp"
#include "launcher/visit/machines.hpp"
#include "launcher/visit/process_table.hpp"

namespace launch {

// An event is compared only with the handlers of its own process, so that its cost doesn't grow with the number of
// handlers. Invocations are in the order of registration; a handler with `once` is returned once.
class EventHandlers {
 public:
  void add(EventHandler handler);
  // Forgets the handlers of that name; false when there is none.
  bool remove(const std::string& name);

  void clear() { by_process_.clear(); }

  std::vector<Invocation> on_event(const ProcessEvent& event);
  std::vector<Invocation> on_line(const ProcessSpec& spec, const std::string& label, OutputStream stream,
                                  std::string_view line);
  std::vector<Invocation> on_lost_machine(const LostMachine& lost);
  std::vector<Invocation> on_returned_machine(const ReturnedMachine& returned);
  std::vector<Invocation> on_shutdown(const std::string& reason);

  bool has_on_shutdown() const;
  // Whether some handler wants lines.
  bool watch_output() const { return watch_output_; }

 private:
  struct Registered {
    std::uint64_t number;
    std::shared_ptr<const EventHandler> handler;
  };

  // Takes those of the machine, for an event that machines have.
  template <typename Event>
  std::vector<Invocation> take_of_machine(const std::string& machine, const EventValues& values);
  // Takes the handlers of the process for which `concerned` is true.
  template <typename Concerned, typename Values>
  std::vector<Invocation> take(const ProcessSpec& spec, const std::string& label, Concerned concerned, Values values);

  std::uint64_t count_ = 0;
  bool watch_output_ = false;
  std::unordered_map<std::string, std::vector<Registered>> by_process_;  // "": every process
};

}  // namespace launch
