// SPDX-License-Identifier: Apache-2.0
// A mark of a launch that its processes can't lose by accident: the hard limit of file locks (RLIMIT_LOCKS). The kernel
// has not looked at this limit since Linux 2.6. Each process inherits it, whatever becomes of its environment, its
// session and its parent, and everybody may read it (/proc/PID/limits).
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <string>

namespace launch {

// The limit is unlimited at first. A launch takes the upper half for its number, and leaves all bits of the lower half
// to a launch within it, whose processes belong to both. A third launch in one another has no mark.
class InheritedMark {
 public:
  InheritedMark() = default;
  explicit InheritedMark(std::uint64_t value) : value_(value) {}
  // Of a launch with this id, whose launcher has had this limit before.
  static InheritedMark make(const std::string& launch_id, std::uint64_t before);

  // Gives it to this process and what it starts, unless its limit can't be a mark.
  static InheritedMark give_to_this_process(const std::string& launch_id);

  std::uint64_t value() const { return value_; }  // 0: none
  bool is_within(std::uint64_t limit) const;      // a launch in this one counts, too
  bool is_on(pid_t pid) const;

 private:
  std::uint64_t value_ = 0;
};

}  // namespace launch
