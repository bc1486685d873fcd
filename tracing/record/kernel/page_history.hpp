// SPDX-License-Identifier: Apache-2.0
// The newest pages of each processor's ring buffer, without a gap between them. A snapshot is written from these.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace tracing::kernel {

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

}  // namespace tracing::kernel
