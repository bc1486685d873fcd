// SPDX-License-Identifier: Apache-2.0
// The last that a process has printed, for those who begin to look.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace launch {

class RecentOutput {
 public:
  static constexpr std::size_t kMost = std::size_t{64} * 1024;  // bytes that are kept

  void add(std::string_view bytes);
  void clear();

  // The last lines, `most` of them; the last one may have no end yet. Begins where a line begins, unless a single
  // line is longer than all that is kept.
  std::string_view last_lines(std::size_t most) const;

 private:
  std::string text_;
  bool is_cut_ = false;  // the text begins within a line
};

}  // namespace launch
