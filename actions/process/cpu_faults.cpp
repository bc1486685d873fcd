// SPDX-License-Identifier: Apache-2.0
#include "actions/process/cpu_faults.hpp"

#include <fmt/format.h>
#include <sched.h>
#include <sys/sysinfo.h>

#include <algorithm>

#include "launcher/process/resource_limits.hpp"

namespace launch {

void find_faults_of_cpus(const std::vector<int>& cpus, const SourceRange& where, LaunchContext& context) {
  // Most nodes name no CPUs. Counting them opens a file of the system, which takes a fifth of the time of a node.
  if (cpus.empty()) {
    return;
  }
  const int count = get_nprocs_conf();
  const auto missing = std::find_if(cpus.begin(), cpus.end(), [&](int cpu) { return cpu >= count; });
  if (missing != cpus.end()) {
    context.exploration().remark({cpus.front() >= count ? Severity::kError : Severity::kWarning,
                                  fmt::format("this machine has no CPU {}", *missing), where,
                                  fmt::format("its CPUs are 0 to {}", count - 1), Finding::kMissingCpu});
    return;
  }
  std::vector<int> forbidden = cpus;
  const std::vector<int> allowed = allowed_cpus();
  std::erase_if(forbidden, [&](int cpu) { return std::binary_search(allowed.begin(), allowed.end(), cpu); });
  if (forbidden.empty() || allowed.empty()) {
    return;
  }
  const std::string text = fmt::format("the launcher may not use the CPUs {}: its cpuset or its affinity has {}",
                                       cpu_list(forbidden), cpu_list(allowed));
  if (context.exploration().is_on()) {
    context.exploration().remark({Severity::kWarning, text, where, {}, Finding::kMissingCpu});
  } else {
    context.scope().warn(where, text);
  }
}

}  // namespace launch
