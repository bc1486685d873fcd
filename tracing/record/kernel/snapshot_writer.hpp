// SPDX-License-Identifier: Apache-2.0
// Writes snapshots of what the ring buffers hold. Snapshots may overlap; what stands in several of them is the same
// packet of the same trace, so a reader of all of them finds each event once.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "tracing/record/kernel/ctf_writer.hpp"
#include "tracing/record/kernel/event_format.hpp"
#include "tracing/record/kernel/page_history.hpp"
#include "tracing/record/kernel/thread_table.hpp"

namespace tracing::kernel {

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
