// SPDX-License-Identifier: Apache-2.0
// What a process has written while it can't be passed on: up to a size. Of what comes later, lines are dropped and
// counted, so that a process never waits for a launcher that is away.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace launch {

// Bytes of one stream, and of all streams of an agent.
inline constexpr std::size_t kMostSpooled = 1024UL * 1024;
inline constexpr std::size_t kMostSpooledOfAll = 32UL * 1024 * 1024;

class OutputSpool {
 public:
  // Adds what fits. After the first line that does not, nothing more is added until take_dropped(). `all` is the number
  // of bytes in all spools.
  void add(std::string_view bytes, std::size_t& all);
  // From the front, so many bytes at most. Empty: there are none.
  std::string take(std::size_t most, std::size_t& all);
  bool empty() const { return begin_ == bytes_.size(); }

  // Bytes have been passed on beside the spool, which is idle.
  void pass(std::string_view bytes) { last_ = bytes.back(); }
  // Whether it is empty, and bytes can be passed on beside it.
  bool is_idle() const { return empty() && !skips_ && !full_; }

  // The number of lines that were dropped since the last time. From now on what comes is added again, from the next
  // beginning of a line on.
  std::uint64_t take_dropped();

 private:
  void end_at_a_line(std::size_t& all);
  void drop(std::string_view bytes);

  std::string bytes_;
  std::size_t begin_ = 0;  // of what has not been taken
  char last_ = '\n';       // of what was added or passed on
  bool full_ = false;
  bool in_line_ = false;  // what was dropped ends within a line
  bool skips_ = false;    // the rest of a line that counts as dropped
  std::uint64_t dropped_ = 0;
};

}  // namespace launch
