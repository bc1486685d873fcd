// SPDX-License-Identifier: Apache-2.0
#include "launcher/process/guardian/inherited_mark.hpp"

#include <sys/resource.h>

#include <cstdlib>
#include <string_view>

#include "launcher/process/guardian/process_scan.hpp"

namespace launch {
namespace {

constexpr int kHalf = 32;  // bits
constexpr std::uint64_t kLower = 0xffff'ffff;

static_assert(sizeof(rlim_t) == sizeof(std::uint64_t) && RLIM_INFINITY > (kLower << (kHalf - 1)));

// The hard limit in "Max file locks            unlimited            unlimited            locks".
std::uint64_t hard_limit_of(pid_t pid) {
  constexpr std::string_view kLine = "\nMax file locks ";
  const std::string limits = read_proc_file(pid, "limits");
  const std::size_t line = limits.find(kLine);
  if (line == std::string::npos) {
    return RLIM_INFINITY;
  }
  char* next = nullptr;
  std::strtoull(limits.c_str() + line + kLine.size(), &next, 10);  // "unlimited" is no number, and stays for the next
  return std::strtoull(next, &next, 10);
}

}  // namespace

InheritedMark InheritedMark::make(const std::string& launch_id, std::uint64_t before) {
  const std::uint64_t number = std::strtoull(launch_id.c_str(), nullptr, 16);
  if (before == RLIM_INFINITY) {
    return InheritedMark((number >> (kHalf + 1) << kHalf) | kLower);
  }
  const bool is_outer = (before & kLower) == kLower;
  return InheritedMark(is_outer ? (before ^ kLower) | ((number & kLower) >> 1) : 0);
}

InheritedMark InheritedMark::give_to_this_process(const std::string& launch_id) {
  rlimit limit{};
  if (::getrlimit(RLIMIT_LOCKS, &limit) != 0) {
    return {};
  }
  const InheritedMark mark = make(launch_id, limit.rlim_max);
  limit = {.rlim_cur = mark.value(), .rlim_max = mark.value()};
  return mark.value() != 0 && ::setrlimit(RLIMIT_LOCKS, &limit) == 0 ? mark : InheritedMark();
}

bool InheritedMark::is_within(std::uint64_t limit) const {
  const bool is_outer = (value_ & kLower) == kLower;
  return value_ != 0 && (is_outer ? limit >> kHalf == value_ >> kHalf : limit == value_);
}

bool InheritedMark::is_on(pid_t pid) const {
  return value_ != 0 && is_within(hard_limit_of(pid));
}

}  // namespace launch
