// SPDX-License-Identifier: Apache-2.0
// What a trace holds: events with their fields and contexts, and losses.
//
// An Event, a Loss, a Value and the texts in them are views into the reader's memory. They are valid until the reader
// moves on. A Trace, a Stream and an EventClass live as long as the reader.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace launch_trace {

// What one tracer recorded on one machine. The chunks of a rotated session and several snapshots are one trace.
struct Trace {
  std::size_t index = 0;  // counts from 0 within one reader
  std::vector<std::filesystem::path> directories;
  std::string uuid;      // empty: it has none
  std::string hostname;  // of the machine; process ids of different machines have nothing to do with each other
  std::string domain;    // "ust" (userspace) or "kernel"
  // All that the tracer says of itself: "tracer_name", "trace_name", "vpid", …
  std::map<std::string, std::variant<std::int64_t, std::string>> environment;
};

// One data stream of a trace: in LTTng, the buffers of one channel on one CPU.
struct Stream {
  std::string file;
  const Trace* trace = nullptr;
  std::optional<std::int64_t> vpid;  // only with buffers for each process: the process that wrote it
};

// What all events of one name in one trace have in common.
struct EventClass {
  std::string name;       // "ros2:rcl_init"
  std::size_t index = 0;  // counts from 0 within one reader: an index for tables of your own
  const Trace* trace = nullptr;
  std::vector<std::string> fields;    // in the order of the payload
  std::vector<std::string> contexts;  // what was recorded beside the payload: "vpid", "perf_thread_instructions", …

  std::optional<std::size_t> field_index(std::string_view field) const;
  std::optional<std::size_t> context_index(std::string_view context) const;
};

// The value of a field or a context. A question for another type than was recorded gives nullopt.
class Value {
 public:
  enum class Kind { kUnsigned, kSigned, kReal, kString, kArray, kStructure, kVariant };
  Kind kind() const;

  std::optional<std::uint64_t> unsigned_integer() const;  // of unsigned integers, such as pointers and sizes
  std::optional<std::int64_t> integer() const;            // of any integer that fits
  std::optional<double> real() const;
  std::optional<std::string_view> string() const;
  std::optional<std::string_view> label() const;  // of an enumeration's value, which is also an integer

  bool is_hexadecimal() const;  // an integer that the trace wants in hexadecimal, such as a pointer

  // Elements of an array or a sequence; members of a structure; 1 for a variant, whose element is the selected option;
  // 0 for anything else.
  std::size_t size() const;
  Value operator[](std::size_t index) const;              // index < size()
  std::string_view member_name(std::size_t index) const;  // of a structure

 private:
  friend struct Access;
  Value() = default;
  alignas(std::uintptr_t) std::array<std::byte, 6 * sizeof(std::uintptr_t)> data_;
};

class Event {
 public:
  std::string_view name() const { return class_->name; }
  const EventClass& event_class() const { return *class_; }
  const Trace& trace() const { return *class_->trace; }
  std::int64_t time_ns() const { return time_ns_; }  // since the epoch, on the tracer's clock

  // Recorded only if the session had these contexts, as sessions of ros2_tracing have. cpu_id is LTTng's own.
  std::optional<std::int64_t> cpu_id() const;
  std::optional<std::int64_t> vpid() const;
  std::optional<std::int64_t> vtid() const;
  std::optional<std::string_view> procname() const;  // at most 15 characters; of the thread, not of the executable

  Value field(std::size_t index) const;  // index < event_class().fields.size()
  std::optional<Value> field(std::string_view name) const;
  Value context(std::size_t index) const;  // index < event_class().contexts.size()
  std::optional<Value> context(std::string_view name) const;

 private:
  friend struct Access;
  const EventClass* class_ = nullptr;
  std::int64_t time_ns_ = 0;
  const void* event_ = nullptr;
};

// Events that the tracer could not keep, according to the trace itself.
struct Loss {
  enum class Kind {
    kEvents,   // the newest events were dropped while the buffers were full
    kPackets,  // the oldest packets were overwritten, each with an unknown number of events
  };
  Kind kind = Kind::kEvents;
  const Stream* stream = nullptr;
  std::optional<std::int64_t> begin_ns;  // the loss lies within this time range, if the trace tells it
  std::optional<std::int64_t> end_ns;
  std::optional<std::uint64_t> count;  // nullopt: some, but the number is unknown
};

}  // namespace launch_trace
