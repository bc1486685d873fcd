// SPDX-License-Identifier: Apache-2.0
#include "tracing/kernel/page_history.hpp"

#include <utility>

#include "tracing/kernel/ring_page.hpp"

namespace tracing::kernel {

void PageHistory::add(unsigned cpu, Page page) {
  Processor& processor = processors_[cpu];
  if (forget_lost_records(page)) processor = {};
  processor.bytes += page.size();
  processor.pages.push_back(std::move(page));
  while (processor.bytes > limit_ && processor.pages.size() > 1) {
    processor.bytes -= processor.pages.front().size();
    processor.pages.pop_front();
  }
}

}  // namespace tracing::kernel
