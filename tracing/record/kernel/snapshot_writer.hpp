// SPDX-License-Identifier: Apache-2.0
// Writes snapshots of what the ring buffers hold. Snapshots may overlap; what stands in several of them is the same
// packet of the same trace, so a reader of all of them finds each event once.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "tracing/record/kernel/ctf_writer.hpp"
#include "tracing/record/kernel/event_format.hpp"
#include "tracing/record/kernel/thread_table.hpp"

namespace tracing::kernel {

// The newest pages of each processor's ring buffer, without a gap between them. A snapshot is written from these.
class PageHistory {
 public:
  using Page = std::vector<std::uint8_t>;  // as trace_pipe_raw gives it

  // A page has the same number, and once it is written the same packet, in all snapshots. Readers of the snapshots
  // know by both that it is one packet.
  struct KeptPage {
    std::uint64_t number = 0;           // counts the pages of a processor
    std::size_t size = 0;               // of the page
    Page bytes;                         // empty once there is a packet
    std::optional<std::string> packet;  // as the snapshots have it
  };
  struct Processor {
    std::deque<KeptPage> pages;
    std::size_t bytes = 0;
    std::uint64_t next_number = 0;
  };

  // `limit` is in bytes of pages for each processor; the newest page is kept in any case.
  explicit PageHistory(std::size_t limit) : limit_(limit) {}

  // Pages of a processor must come in their order. When records were overwritten before this page, the pages before it
  // are dropped, a number is left out, and the page no longer reports the loss. Returns whether it was so.
  bool add(unsigned cpu, Page page);
  void clear();

  std::map<unsigned, Processor>& processors() { return processors_; }

 private:
  std::size_t limit_;
  std::map<unsigned, Processor> processors_;
};

class SnapshotWriter {
 public:
  // `limit` as in PageHistory; `no_threads` is a table that has learnt nothing.
  SnapshotWriter(std::size_t limit, std::vector<EventFormat> formats, std::vector<std::string> context_fields,
                 ThreadTable no_threads);

  // A page that was read since the last snapshot. Pages of a processor must come in their order.
  void add(unsigned cpu, PageHistory::Page page);
  // Writes the kept pages into the directory, which must exist. Throws std::system_error.
  void write(const std::filesystem::path& directory, const TraceClock& clock);
  // The next snapshot begins after this one.
  void clear() { history_.clear(); }

 private:
  PageHistory history_;
  std::vector<EventFormat> formats_;
  std::vector<std::string> context_fields_;
  ThreadTable no_threads_;
  ThreadTable threads_;
  TraceUuid uuid_ = random_uuid();
};

}  // namespace tracing::kernel
