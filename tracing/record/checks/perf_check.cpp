// SPDX-License-Identifier: Apache-2.0
#include "tracing/record/checks/perf_check.hpp"

#include <fmt/core.h>
#include <linux/perf_event.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <string_view>

namespace tracing {

std::string why_not_countable(const PerfCounter& counter) {
  perf_event_attr attributes{};
  attributes.size = sizeof attributes;
  attributes.type = counter.type;
  attributes.config = counter.config;
  attributes.disabled = 1;
  attributes.exclude_kernel = 1;  // as LTTng-UST does where it must
  const long fd = syscall(SYS_perf_event_open, &attributes, 0, -1, -1, PERF_FLAG_FD_CLOEXEC);
  if (fd < 0) {
    return std::strerror(errno);
  }
  close(static_cast<int>(fd));
  return {};
}

std::vector<std::string> perf_warnings(const std::vector<std::string>& context_fields_ust) {
  constexpr std::string_view kPrefix = "perf:thread:";
  std::vector<std::string> warnings;
  for (const std::string& name : context_fields_ust) {
    if (!name.starts_with(kPrefix)) {
      continue;
    }
    const auto counter = find_perf_counter(name.substr(kPrefix.size()));
    if (!counter) {
      continue;
    }
    if (const std::string reason = why_not_countable(*counter); !reason.empty()) {
      warnings.push_back(
          fmt::format("context field '{}' cannot be counted here ({}): LTTng will record no events; leave it "
                      "out, or see whether /proc/sys/kernel/perf_event_paranoid forbids it",
                      name, reason));
    }
  }
  return warnings;
}

}  // namespace tracing
