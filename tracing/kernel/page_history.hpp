// SPDX-License-Identifier: Apache-2.0
// The newest pages of each processor's ring buffer, without a gap between them. A snapshot is written from these.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <vector>

namespace tracing::kernel {

class PageHistory {
 public:
  using Page = std::vector<std::uint8_t>;  // as trace_pipe_raw gives it

  // `limit` is in bytes for each processor; the newest page is kept in any case.
  explicit PageHistory(std::size_t limit) : limit_(limit) {}

  // Pages of a processor must come in their order. When records were overwritten before this page, the pages before it
  // are dropped, and the page no longer reports the loss.
  void add(unsigned cpu, Page page);
  void clear() { processors_.clear(); }

  struct Processor {
    std::deque<Page> pages;
    std::size_t bytes = 0;
  };
  const std::map<unsigned, Processor>& processors() const { return processors_; }

 private:
  std::size_t limit_;
  std::map<unsigned, Processor> processors_;
};

}  // namespace tracing::kernel
