// SPDX-License-Identifier: Apache-2.0
// The newest pages of each processor's ring buffer, without a gap between them: what a snapshot is written from.
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

  // `limit`: bytes for each processor; the newest page is kept in any case.
  explicit PageHistory(std::size_t limit) : limit_(limit) {}

  // Pages of a processor come in their order. One before which records were overwritten ends what was there before it;
  // it says nothing of them any more.
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
