// SPDX-License-Identifier: Apache-2.0
// Writes events of the kernel as a CTF 1.8 trace, in the form of LTTng's kernel tracer: one stream file per processor,
// domain "kernel". It uses the clock of the userspace trace beside it.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "tracing/record/kernel/event_format.hpp"
#include "tracing/record/kernel/ring_page.hpp"
#include "tracing/record/kernel/thread_table.hpp"

namespace tracing::kernel {

// CLOCK_MONOTONIC, and its distance from the time of day.
struct TraceClock {
  std::string uuid;
  std::int64_t offset = 0;  // nanoseconds
};

// The clock of the userspace trace in `directory` (from its metadata), so that raw time stamps put both traces in one
// order. A clock of our own when there is no such trace.
TraceClock clock_beside(const std::filesystem::path& directory);

// The context fields that can be recorded; vpid and vtid are those of the first namespace of processes.
inline constexpr std::array<std::string_view, 5> kContextFields = {"procname", "pid", "tid", "vpid", "vtid"};

// Snapshots with the same number are parts of one trace.
using TraceUuid = std::array<std::uint8_t, 16>;
TraceUuid random_uuid();

class CtfWriter {
 public:
  // The directory must exist. Every event gets the `context_fields`, which are some of kContextFields, and always the
  // thread. Functions that write throw std::system_error when a file can't be written.
  CtfWriter(std::filesystem::path directory, const TraceUuid& uuid, const std::vector<EventFormat>& formats,
            const std::vector<std::string>& context_fields, ThreadTable& threads);

  // Writes one page of a processor's ring buffer as one packet. Pages of a processor must come in their order.
  void write_page(unsigned cpu, std::span<const std::uint8_t> page);
  // The packet of the page, with this number. Pages must come in their order.
  std::string packet_of(unsigned cpu, std::uint64_t number, std::span<const std::uint8_t> page);
  void write_packet(unsigned cpu, const std::string& packet);
  void write_metadata(const TraceClock& clock) const;

  std::uint64_t events() const { return events_; }
  std::uint64_t lost_events() const { return lost_events_; }
  std::uint64_t bytes() const { return bytes_; }

 private:
  struct Content {
    RingPage page;
    std::string events;
  };
  struct Stream {
    std::uint64_t packets = 0;
    std::uint64_t discarded = 0;  // so far
  };

  Content content_of(unsigned cpu, std::span<const std::uint8_t> page);
  std::string packet_of(unsigned cpu, std::uint64_t number, const Content& content) const;
  void append_context(std::string& packet, unsigned cpu, std::uint64_t time, std::int32_t thread) const;
  void append_record(std::string& packet, unsigned cpu, std::uint64_t time, std::span<const std::uint8_t> record);

  std::filesystem::path directory_;
  std::unordered_map<std::uint16_t, EventFormat> formats_;
  std::vector<std::string> context_fields_;
  ThreadTable& threads_;
  TraceUuid uuid_;
  std::map<unsigned, Stream> streams_;
  std::uint64_t events_ = 0;
  std::uint64_t lost_events_ = 0;
  std::uint64_t bytes_ = 0;
};

}  // namespace tracing::kernel
