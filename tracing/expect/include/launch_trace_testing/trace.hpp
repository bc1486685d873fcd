// SPDX-License-Identifier: Apache-2.0
// A whole trace in memory, with what it means: callbacks that ran, and the ways of messages.
//
//   const Trace trace("/home/me/.ros/tracing/run");
//   for (const Event& event : trace) …
//
// Copies of a trace share everything; references into it stay valid as long as one of the copies lives. It may be read
// from several threads at once.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <iosfwd>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "launch_trace_testing/event.hpp"

namespace launch_trace_testing {

// There is no trace, or it can't be read. what() has one line, and a second one with help if there is some.
class TraceError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// Events that the tracer could not keep.
struct Loss {
  bool whole_packets = false;          // packets, each with an unknown number of events
  std::optional<std::uint64_t> count;  // nullopt: some, but the number is unknown
  std::int64_t begin_ns = 0;           // 0: unknown
  std::int64_t end_ns = 0;             // 0: unknown
  std::string stream;                  // the file
};

// One run of a callback. Times are in nanoseconds since the epoch.
struct CallbackRun {
  std::string node;     // "/ns/name"; empty when the trace does not tell
  std::string topic;    // of a subscription
  std::string service;  // of a service or client
  bool is_timer = false;
  std::int64_t period_ns = 0;  // of a timer
  std::string symbol;          // the readable name of the function
  std::int64_t vpid = -1;
  std::int64_t vtid = -1;
  std::int64_t start_ns = 0;
  std::int64_t end_ns = 0;  // of an unfinished run: the latest time at which it may have ended
  bool finished = true;
};

// The way of one message to one subscription; a publication that nobody took is there once. A time is 0 where the way
// ended before. All times are in nanoseconds since the epoch.
struct Delivery {
  std::string topic;
  std::string publisher;   // name of the node
  std::string subscriber;  // name of the node; empty when nobody took the message
  std::int64_t publisher_vpid = -1;
  std::int64_t publisher_vtid = -1;
  std::int64_t subscriber_vpid = -1;
  std::int64_t subscriber_vtid = -1;
  std::int64_t called_ns = 0;     // publish() was called
  std::int64_t published_ns = 0;  // the middleware, or a buffer of the process, got the message
  std::int64_t taken_ns = 0;
  // Of a message that needs no callback, because what took it handles it itself, such as a client of an action: when it
  // was taken.
  std::int64_t callback_start_ns = 0;
  std::int64_t callback_end_ns = 0;
};

// What the version of ros2_tracing that has recorded a topic leaves open: before 8.0 publications have no timestamp,
// and which one a message is was found by its time.
struct MessageDoubts {
  std::string topic;
  std::size_t estimated = 0;  // messages whose publication was found
  std::size_t taken = 0;      // that were taken or began a callback, and whose publication is not known
  std::size_t published = 0;  // that were published, and may have been taken or not
};

struct ReadOptions {
  // Events that are not accepted are left out, and with them the objects and messages that they tell of.
  std::function<bool(const Event&)> accepts;
};

class Trace {
 public:
  Trace();  // without events
  // Reads all traces at and below the directories. Throws TraceError when there is none; damage is kept instead.
  explicit Trace(const std::filesystem::path& directory, const ReadOptions& options = {});
  explicit Trace(const std::vector<std::filesystem::path>& directories, const ReadOptions& options = {});

  const std::vector<Event>& events() const;  // in the order of time
  const std::vector<Loss>& losses() const;
  // What could not be read, a line each.
  const std::vector<std::string>& damage() const;
  const std::vector<std::filesystem::path>& directories() const;

  const std::vector<CallbackRun>& callbacks() const;  // by start
  const std::vector<Delivery>& deliveries() const;    // by publication

  const std::vector<MessageDoubts>& doubts() const;  // of topics that have some
  // The versions of tracetools that nodes have named when they began: "6.3.2", "4.1.1, 6.3.2"; empty: none has.
  const std::string& tracetools() const;
  // The trace has rcl_publish, and neither rmw_publish nor rmw_take.
  bool lacks_middleware() const;

  std::int64_t begin_ns() const;  // of the first event; 0 without events
  std::int64_t end_ns() const;    // of the last event

  // A trace is a container of its events.
  using value_type = Event;
  using const_iterator = std::vector<Event>::const_iterator;
  using iterator = const_iterator;
  const_iterator begin() const { return events().begin(); }
  const_iterator end() const { return events().end(); }
  std::size_t size() const { return events().size(); }
  bool empty() const { return events().empty(); }

 private:
  std::shared_ptr<const class TraceStore> store_;
};

// "a trace with 61 events of 2 processes"
std::string to_string(const Trace& trace);
std::ostream& operator<<(std::ostream& stream, const Trace& trace);
// GoogleTest would print each event.
void PrintTo(const Trace& trace, std::ostream* stream);

}  // namespace launch_trace_testing
