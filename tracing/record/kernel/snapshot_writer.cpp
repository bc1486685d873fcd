// SPDX-License-Identifier: Apache-2.0
#include "tracing/record/kernel/snapshot_writer.hpp"

#include <span>
#include <utility>

#include "tracing/record/kernel/ring_page.hpp"

namespace tracing::kernel {

bool PageHistory::add(unsigned cpu, Page page) {
  Processor& processor = processors_[cpu];
  const bool has_gap = forget_lost_records(page);
  if (has_gap) {
    processor = {.pages = {}, .bytes = 0, .next_number = processor.next_number + 1};
  }
  const std::size_t size = page.size();
  processor.bytes += size;
  processor.pages.push_back({.number = processor.next_number++, .size = size, .bytes = std::move(page)});
  while (processor.bytes > limit_ && processor.pages.size() > 1) {
    processor.bytes -= processor.pages.front().size;
    processor.pages.pop_front();
  }
  return has_gap;
}

void PageHistory::clear() {
  for (auto& [cpu, processor] : processors_) {
    processor = {.pages = {}, .bytes = 0, .next_number = processor.next_number};
  }
}

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
