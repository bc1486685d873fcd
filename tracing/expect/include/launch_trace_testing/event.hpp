// SPDX-License-Identifier: Apache-2.0
// An event of a trace, kept in memory with all its fields.
//
//   const Event& take = …;
//   take.number("source_timestamp"), take.text("topic_name"), take.procname(), take.time_ns()
//
// Everything here may be read from several threads at once.
#pragma once

#include <cstdint>
#include <iosfwd>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace launch_trace_testing {

// What a field holds.
struct Value {
  struct Enumeration {
    std::int64_t number = 0;
    std::string label;  // empty: the number has none
  };
  struct Member;
  using Array = std::vector<Value>;
  using Structure = std::vector<Member>;

  std::variant<std::uint64_t, std::int64_t, double, std::string, Enumeration, Array, Structure> data;
  bool hexadecimal = false;  // an integer that the trace wants in hexadecimal, such as a pointer

  // Nothing when it is of another kind, or a number that does not fit.
  std::optional<std::uint64_t> unsigned_integer() const;
  std::optional<std::int64_t> integer() const;
  std::optional<double> real() const;  // of any number
  std::optional<std::string_view> text() const;
  const Array* array() const { return std::get_if<Array>(&data); }
};

struct Value::Member {
  std::string name;
  Value value;
};

// "10", "0x7f00", "\"/ping\"", "(1 2 3)", "(x=1 y=2)"
std::string to_string(const Value& value);

// What the events of one name in one trace have in common.
struct EventClass {
  std::string name;                   // "ros2:rcl_publisher_init"
  std::string host;                   // the machine; empty when the trace does not tell
  std::vector<std::string> fields;    // of the payload, in order
  std::vector<std::string> contexts;  // what was recorded beside it, without vpid, vtid and procname
};

class Event {
 public:
  const std::string& name() const { return class_->name; }
  const std::string& host() const { return class_->host; }
  const EventClass& event_class() const { return *class_; }
  std::int64_t time_ns() const { return time_ns_; }   // since the epoch, on the tracer's clock
  std::size_t position() const { return position_; }  // in the trace, from 0: events of one time have an order, too
  std::int64_t cpu_id() const { return cpu_id_; }     // -1: not recorded
  std::int64_t vpid() const { return vpid_; }         // the process; -1: not recorded
  std::int64_t vtid() const { return vtid_; }         // the thread; -1: not recorded
  const std::string& procname() const {
    return *procname_;
  }  // of the thread, at most 15 characters; empty: not recorded

  // A field of the payload, or a context beside it; null when the event has none of this name.
  const Value* find(std::string_view field) const;
  // The same; throws std::out_of_range, which names the fields that there are.
  const Value& at(std::string_view field) const;
  // Of a field that holds this kind of value. Throw std::out_of_range, or std::invalid_argument for another kind.
  std::uint64_t handle(std::string_view field) const;
  std::int64_t number(std::string_view field) const;
  const std::string& text(std::string_view field) const;

  bool same_thread(const Event& other) const {
    return vtid_ == other.vtid_ && vpid_ == other.vpid_ && class_->host == other.class_->host;
  }
  bool same_process(const Event& other) const { return vpid_ == other.vpid_ && class_->host == other.class_->host; }

 private:
  friend class TraceStore;
  std::shared_ptr<const EventClass> class_;
  std::shared_ptr<const std::string> procname_;
  std::int64_t time_ns_ = 0;
  std::size_t position_ = 0;
  std::int64_t cpu_id_ = -1;
  std::int64_t vpid_ = -1;
  std::int64_t vtid_ = -1;
  std::vector<Value> values_;  // of the fields, then of the contexts
};

// "ros2:rcl_take message=0x30 of ping[71/71]"
std::string to_string(const Event& event);
std::ostream& operator<<(std::ostream& stream, const Event& event);

}  // namespace launch_trace_testing
