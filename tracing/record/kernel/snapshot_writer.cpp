// SPDX-License-Identifier: Apache-2.0
#include "tracing/record/kernel/snapshot_writer.hpp"

#include <cstdint>
#include <span>
#include <utility>

#include "tracing/record/kernel/ring_page.hpp"

namespace tracing::kernel {

SnapshotWriter::SnapshotWriter(std::size_t limit, std::vector<EventFormat> formats,
                               std::vector<std::string> context_fields, ThreadTable no_threads)
    : history_(limit),
      formats_(std::move(formats)),
      context_fields_(std::move(context_fields)),
      no_threads_(no_threads),
      threads_(std::move(no_threads)) {}

void SnapshotWriter::add(unsigned cpu, PageHistory::Page page) {
  // In what was overwritten, the number of a thread may have passed to another one. /proc tells of those that run.
  if (history_.add(cpu, std::move(page))) {
    threads_ = no_threads_;
  }
}

void SnapshotWriter::write(const std::filesystem::path& directory, const TraceClock& clock) {
  CtfWriter writer(directory, uuid_, formats_, context_fields_, threads_);
  for (auto& [cpu, processor] : history_.processors()) {
    for (const PageHistory::KeptPage& page : processor.pages) {
      read_ring_page(page.bytes,
                     [&](std::uint64_t time, std::span<const std::uint8_t> record) { threads_.learn(time, record); });
    }
  }
  for (auto& [cpu, processor] : history_.processors()) {
    for (PageHistory::KeptPage& page : processor.pages) {
      if (!page.packet) {
        page.packet = writer.packet_of(cpu, page.number, page.bytes);
        page.bytes = {};
      }
      writer.write_packet(cpu, *page.packet);
    }
  }
  threads_.forget_the_past();
  writer.write_metadata(clock);
}

}  // namespace tracing::kernel
