// SPDX-License-Identifier: Apache-2.0
// One recorded event, as views into the reader's memory; nothing is copied.
//
// Everything in an Event is valid until TraceSink::on_event returns; its EventClass and Stream live as long as the
// TraceReader.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tracing/decode/ctf/field.hpp"
#include "tracing/decode/ctf/streams/stream_cursor.hpp"
#include "tracing/decode/ctf/trace_class.hpp"
#include "tracing/decode/reader/recording.hpp"

struct bt_field;  // libbabeltrace2's

namespace tracing {

// A trace: what one tracer recorded on one machine, in one or several directories.
struct TraceDescription {
  std::vector<std::filesystem::path>
      directories;   // the chunks of a rotated session and several snapshots are one trace
  std::string uuid;  // empty: it has none
  // As the tracer describes itself: "hostname", "domain" ("ust" or "kernel"), "tracer_name", …
  ctf::Environment environment;

  // The value of an entry of the environment that is a text; empty when there is none.
  std::string_view text(const std::string& name) const { return ctf::environment_text(environment, name); }
};

// One data stream of a trace: in LTTng, the buffers of one channel on one CPU.
struct Stream {
  std::string name;                  // path of the stream file
  std::size_t trace = 0;             // which trace below the directory, counted from 0
  std::optional<std::int64_t> vpid;  // only with buffers per process (PER_PID): the process that wrote it
};

// The facts that all events of one name in one trace have in common.
struct EventClass {
  std::string name;                 // "ros2:rcl_init"
  std::size_t id = 0;               // counts from 0 within one reader: an index for the caller's own tables
  std::size_t trace = 0;            // as in Stream
  std::vector<std::string> fields;  // of the payload, in order
  // What the tracer recorded beside the payload, such as "vpid" or "perf_thread_instructions". The contexts of all
  // events of a stream come first, then those of this event alone.
  std::vector<std::string> contexts;
  std::size_t stream_contexts = 0;       // the number of the former
  const Recording* recording = nullptr;  // lives as long as the reader; null in an event that no reader made

  std::optional<std::size_t> index_of(std::string_view field) const;
  std::optional<std::size_t> index_of_context(std::string_view context) const;
};

// What somebody wants to know of each event class, found out when its first event comes.
template <class Fact>
class ByEventClass {
 public:
  // `find()` is asked once for each class. The fact is valid until the next call.
  template <class Find>
  const Fact& of(const EventClass& event_class, Find find) {
    if (event_class.id >= facts_.size()) {
      facts_.resize(event_class.id + 1);
    }
    std::optional<Fact>& fact = facts_[event_class.id];
    if (!fact) {
      fact.emplace(find());
    }
    return *fact;
  }

 private:
  std::vector<std::optional<Fact>> facts_;  // by EventClass::id
};

// The value of one field. Asking for another type than was recorded gives nullopt.
class FieldValue {
 public:
  explicit FieldValue(const ctf::Field& field) : direct_(field) {}
  explicit FieldValue(const bt_field* field) : foreign_(field) {}

  std::optional<std::uint64_t> unsigned_integer() const {  // only for unsigned fields, such as pointers and sizes
    return foreign_ == nullptr ? direct_.unsigned_integer() : foreign_unsigned_integer();
  }
  std::optional<std::int64_t> integer() const {  // for any integer that fits
    return foreign_ == nullptr ? direct_.integer() : foreign_integer();
  }
  std::optional<double> real() const;
  std::optional<std::string_view> string() const;

  bool is_hexadecimal() const;  // an integer that the trace wants in hexadecimal, such as a pointer
  bool is_enumeration() const {
    return foreign_ == nullptr ? direct_.type->kind == ctf::FieldKind::kEnumeration : is_foreign_enumeration();
  }
  bool is_array() const;
  bool is_structure() const;
  bool is_variant() const;
  // The number of elements of an array or a sequence, or of members of a structure. It is 1 for a variant, whose
  // element is the selected option, and 0 for anything else.
  std::size_t size() const;
  FieldValue operator[](std::size_t index) const;             // index < size()
  std::string_view member_name(std::size_t index) const;      // for a structure
  std::optional<std::string_view> enumeration_label() const;  // the first label of the value, if it has one

 private:
  bool is_foreign_enumeration() const;
  std::optional<std::uint64_t> foreign_unsigned_integer() const;
  std::optional<std::int64_t> foreign_integer() const;

  ctf::Field direct_;
  const bt_field* foreign_ = nullptr;  // null: `direct_` is the field
};

struct Event {
  const EventClass* event_class = nullptr;
  std::int64_t timestamp_ns = 0;  // since the epoch, on the tracer's clock

  // Recorded only when the session enabled these contexts (ros2_tracing's default does); cpu_id is LTTng's own.
  std::optional<std::int64_t> cpu_id;
  std::optional<std::int64_t> vpid;
  std::optional<std::int64_t> vtid;
  std::optional<std::string_view> procname;  // at most 15 characters; of the thread, not of the executable

  // One of the two holds the fields, for field().
  const ctf::Record* record = nullptr;
  const bt_field* foreign_payload = nullptr;
  // The same for context().
  const ctf::Record* stream_context = nullptr;
  const ctf::Record* event_context = nullptr;
  const bt_field* foreign_stream_context = nullptr;
  const bt_field* foreign_event_context = nullptr;

  std::string_view name() const { return event_class->name; }
  FieldValue field(std::size_t index) const {  // index < event_class->fields.size()
    return record != nullptr ? FieldValue((*record)[index]) : foreign_field(index);
  }
  std::optional<FieldValue> field(std::string_view field_name) const;
  FieldValue context(std::size_t index) const;  // index < event_class->contexts.size()
  std::optional<FieldValue> context(std::string_view context_name) const;

 private:
  FieldValue foreign_field(std::size_t index) const;
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

// What a reader gives next: an event or a loss, or neither at the end.
struct TraceItem {
  const Event* event = nullptr;
  const Loss* loss = nullptr;
  explicit operator bool() const { return event != nullptr || loss != nullptr; }
};

}  // namespace tracing
