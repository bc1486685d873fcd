// SPDX-License-Identifier: Apache-2.0
// Tells when an event of a running program matches a rule, without reading a trace: LTTng's triggers.
#pragma once

#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "tracing/record/plan/event_rule.hpp"

struct lttng_notification_channel;
struct lttng_trigger;

namespace tracing {

class EventWatch {
 public:
  // Calls `seen` with the text of the rule (event_rule.hpp, userspace) from a thread of its own, a few milliseconds
  // after the event at most. Several events in quick succession may be reported once. `name` begins the names of the
  // triggers at the session daemon, which must run. Throws TraceError.
  EventWatch(const std::string& name, const std::vector<std::string>& rules,
             std::function<void(const std::string& rule)> seen);
  ~EventWatch();
  EventWatch(const EventWatch&) = delete;
  EventWatch& operator=(const EventWatch&) = delete;

  // Removes the triggers that a watch of this name has left at the session daemon because its process was killed.
  static void clean_up(const std::string& name);

 private:
  struct TriggerDeleter {
    void operator()(lttng_trigger* trigger) const;
  };
  struct ChannelDeleter {
    void operator()(lttng_notification_channel* channel) const;
  };

  void add(const std::string& name, const std::string& text);
  void add(const std::string& name, const EventRule& parsed, const std::string& text);
  void unregister();
  void wait_for_events();
  bool tell_next();

  std::function<void(const std::string&)> seen_;
  std::vector<std::pair<std::string, std::string>> rules_;  // the trigger's name, the rule's text
  std::vector<std::unique_ptr<lttng_trigger, TriggerDeleter>> triggers_;
  std::unique_ptr<lttng_notification_channel, ChannelDeleter> channel_;
  std::mutex mutex_;
  std::condition_variable stopped_;
  bool stop_ = false;
  std::thread thread_;
};

}  // namespace tracing
