// SPDX-License-Identifier: Apache-2.0
#include "tracing/record/kernel/page_history.hpp"

#include <utility>

#include "tracing/record/kernel/ring_page.hpp"

namespace tracing::kernel {

bool PageHistory::add(unsigned cpu, Page page) {
  Processor& processor = processors_[cpu];
  const bool has_gap = forget_lost_records(page);
  if (has_gap) {
    processor = {.pages = {}, .bytes = 0, .next_number = processor.next_number + 1};
  }
  processor.bytes += page.size();
  processor.pages.push_back({.number = processor.next_number++, .size = page.size(), .bytes = std::move(page)});
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

}  // namespace tracing::kernel
