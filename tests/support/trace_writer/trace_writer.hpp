// SPDX-License-Identifier: Apache-2.0
// Writes a CTF 1.8 trace with the layout of LTTng-UST 2.13 (large event header, contexts per event, one stream file
// per CPU), so that readers can be tested on exactly known events, losses and damage without a tracer.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tracing/decode/reader/ros2_events.hpp"

namespace tracing::testing {

struct Thread {
  std::int64_t vpid = 0;
  std::int64_t vtid = 0;
  std::string_view procname;
  std::uint32_t pid_ns = 0;  // with Options::pid_ns
};

class TraceWriter {
 public:
  struct Options {
    bool contexts = true;                            // vpid, vtid, procname of every event
    std::optional<std::int64_t> per_process_vpid{};  // as with buffers per process
    std::uint8_t identity = 1;                       // traces with the same identity are parts of one trace
    std::size_t packet_size = 1 << 16;               // bytes; a packet with more than this ends
    std::optional<std::int32_t> vppid{};             // another context of every event
    bool pid_ns = false;                             // Thread::pid_ns of every event
  };

  // Creates the directory.
  explicit TraceWriter(const std::filesystem::path& directory);
  TraceWriter(const std::filesystem::path& directory, Options options);

  // Times of one CPU must not decrease.
  template <class Struct>
  void write(unsigned cpu, std::int64_t time_ns, const Thread& thread, const Struct& event);
  void write(unsigned cpu, std::int64_t time_ns, const Thread& thread, const ros2::AnyEvent& event);

  // Declares an event class of the caller's own: `fields` is in CTF's language, and the payload of `write_raw` must
  // match it.
  std::uint16_t declare(std::string_view name, const std::string& fields);
  void write_raw(unsigned cpu, std::int64_t time_ns, const Thread& thread, std::uint16_t id, std::string_view payload);

  void end_packet(unsigned cpu);
  void discard_events(unsigned cpu, std::uint32_t count);  // counted in the packet that is being filled
  // The packet that is being filled says that nothing was discarded so far, as LTTng's do now and then under overload.
  void hide_discarded_events(unsigned cpu);
  void lose_packets(unsigned cpu, std::uint64_t count);  // between the packet that is being filled and the one before

  // Writes the packets that are left. Nothing may be written after this.
  void finish();

 private:
  struct Cpu {
    std::string events;
    std::int64_t begin_ns = 0;
    std::int64_t end_ns = 0;
    std::uint64_t sequence_number = 0;
    std::uint64_t discarded = 0;
    bool hides_discarded = false;
  };

  std::string metadata() const;
  template <class Struct>
  static std::string describe_fields();

  std::filesystem::path directory_;
  Options options_;
  std::map<std::string, std::uint16_t, std::less<>> ids_;
  std::string event_descriptions_;
  std::map<unsigned, Cpu> cpus_;
  std::string payload_;
};

namespace detail {

template <class Integer>
void append(std::string& bytes, Integer value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

struct AppendField {
  std::string& payload;

  template <ros2::FieldType type, class Member>
  void operator()(std::string_view, const Member& member) {
    if constexpr (type == ros2::FieldType::kString) {
      payload.append(member);
      payload.push_back('\0');
    } else if constexpr (type == ros2::FieldType::kBool) {
      append(payload, std::int32_t{member});
    } else if constexpr (type == ros2::FieldType::kGid) {
      payload.append(reinterpret_cast<const char*>(member.bytes.data()), 16);
    } else if constexpr (type == ros2::FieldType::kPointers) {
      append(payload, static_cast<std::uint64_t>(member.size()));
      for (const ros2::Handle handle : member) {
        append(payload, handle);
      }
    } else {
      append(payload, member);
    }
  }
};

// One field in CTF's language, in the form of lttng-ust.
std::string describe_field(ros2::FieldType type, std::string_view name);

}  // namespace detail

template <class Struct>
std::string TraceWriter::describe_fields() {
  std::string description;
  Struct event;
  Struct::for_each_field(event, [&]<ros2::FieldType type>(std::string_view name, auto&) {
    description += detail::describe_field(type, name);
  });
  return description;
}

template <class Struct>
void TraceWriter::write(unsigned cpu, std::int64_t time_ns, const Thread& thread, const Struct& event) {
  auto known = ids_.find(Struct::kName);
  const std::uint16_t id = known != ids_.end() ? known->second : declare(Struct::kName, describe_fields<Struct>());
  payload_.clear();
  Struct::for_each_field(event, detail::AppendField{payload_});
  write_raw(cpu, time_ns, thread, id, payload_);
}

}  // namespace tracing::testing
