// SPDX-License-Identifier: Apache-2.0
// What stands in the way of real time.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <iterator>
#include <map>

#include "launcher/process/resource_limits.hpp"
#include "programs/launch/doctor/machine.hpp"

namespace launch {
namespace {

constexpr const char* kArea = "real time";
constexpr unsigned kSysNice = 23;  // CAP_SYS_NICE
constexpr unsigned kIpcLock = 14;  // CAP_IPC_LOCK
// A processor that sleeps deeper takes longer to wake up.
constexpr std::uint64_t kLongWakeUp = 50;  // microseconds

MachineCheck fine(const char* name, std::string found) {
  return {kArea, name, true, std::move(found), ""};
}
MachineCheck bad(const char* name, std::string found, std::string advice) {
  return {kArea, name, false, std::move(found), std::move(advice)};
}

std::uint64_t number(const std::string& text) {
  return std::strtoull(text.c_str(), nullptr, 10);
}

// The directories of CPUs: "cpu0", "cpu1".
std::vector<int> present_cpus(const Machine& machine) {
  std::vector<int> cpus;
  for (const std::string& name : machine.entries("sys/devices/system/cpu", "cpu")) {
    if (name.size() > 3 && std::all_of(name.begin() + 3, name.end(), [](char c) { return c >= '0' && c <= '9'; })) {
      cpus.push_back(std::atoi(name.c_str() + 3));
    }
  }
  std::sort(cpus.begin(), cpus.end());
  return cpus;
}

MachineCheck check_kernel(const Machine& machine) {
  const bool is_real_time = machine.line("sys/kernel/realtime") == "1" ||
                            machine.line("proc/version").find("PREEMPT_RT") != std::string::npos;
  return is_real_time ? fine("kernel", "PREEMPT_RT")
                      : bad("kernel", "not PREEMPT_RT: a thread may have to wait for the kernel, whatever its priority",
                            "install a kernel with PREEMPT_RT, on Debian linux-image-rt-amd64");
}

MachineCheck check_governor(const Machine& machine, const std::vector<int>& cpus) {
  std::map<std::string, std::vector<int>> by_governor;
  for (const int cpu : cpus) {
    const std::string governor =
        machine.line(fmt::format("sys/devices/system/cpu/cpu{}/cpufreq/scaling_governor", cpu));
    if (!governor.empty()) {
      by_governor[governor].push_back(cpu);
    }
  }
  if (by_governor.empty()) {
    return fine("governor", "the frequency of the CPUs is not scaled by the kernel");
  }
  std::vector<std::string> texts;
  for (const auto& [governor, of] : by_governor) {
    texts.push_back(fmt::format("CPUs {}: {}", cpu_list(of), governor));
  }
  const std::string found = fmt::format("{}", fmt::join(texts, ", "));
  return by_governor.size() == 1 && by_governor.contains("performance")
             ? fine("governor", found)
             : bad("governor", found, "cpupower frequency-set -g performance");
}

MachineCheck check_idle_states(const Machine& machine, const std::vector<int>& cpus) {
  std::uint64_t longest = 0;
  std::string name;
  for (const int cpu : cpus) {
    const std::string directory = fmt::format("sys/devices/system/cpu/cpu{}/cpuidle", cpu);
    for (const std::string& state : machine.entries(directory, "state")) {
      const std::string file = directory + "/" + state;
      const std::uint64_t latency = number(machine.line(file + "/latency"));
      if (machine.line(file + "/disable") != "1" && latency > longest) {
        longest = latency;
        name = machine.line(file + "/name");
      }
    }
  }
  return longest < kLongWakeUp
             ? fine("idle states", longest == 0 ? "none takes time to leave"
                                                : fmt::format("the deepest, {}, takes {} us to leave", name, longest))
             : bad("idle states", fmt::format("the deepest, {}, takes {} us to leave", name, longest),
                   fmt::format("cpupower idle-set -D {}", kLongWakeUp - 1));
}

MachineCheck check_priority(const Machine& machine) {
  const std::optional<std::uint64_t> limit = machine.soft_limit("Max realtime priority");
  if (machine.has_capability(kSysNice)) {
    return fine("priorities", "allowed, by CAP_SYS_NICE");
  }
  return !limit || *limit > 0
             ? fine("priorities", limit ? fmt::format("allowed up to {}", *limit) : std::string("allowed"))
             : bad("priorities", "sched_policy fifo and rr are not allowed to this user (RLIMIT_RTPRIO is 0)",
                   "add `YOUR_USER - rtprio 98` to a file in /etc/security/limits.d and log in again");
}

MachineCheck check_locked_memory(const Machine& machine) {
  const std::optional<std::uint64_t> limit = machine.soft_limit("Max locked memory");
  return !limit || machine.has_capability(kIpcLock)
             ? fine("locked memory", "mlockall(2) is allowed")
             : bad("locked memory", fmt::format("programs may lock {} bytes only", *limit),
                   "add `YOUR_USER - memlock unlimited` to a file in /etc/security/limits.d and log in again");
}

MachineCheck check_throttling(const Machine& machine) {
  const std::string runtime = machine.line("proc/sys/kernel/sched_rt_runtime_us");
  const std::uint64_t period = number(machine.line("proc/sys/kernel/sched_rt_period_us"));
  if (runtime.empty() || runtime == "-1" || number(runtime) >= period) {
    return fine("throttling", "real-time threads are not throttled");
  }
  constexpr std::uint64_t kUsualPercent = 95;
  const std::string found =
      fmt::format("real-time threads get {} us of each {} us (sched_rt_runtime_us)", runtime, period);
  return number(runtime) * 100 >= period * kUsualPercent
             ? fine("throttling", found)
             : bad("throttling", found, "sysctl kernel.sched_rt_runtime_us=950000");
}

MachineCheck check_isolation(const Machine& machine, const std::vector<int>& chosen) {
  const std::vector<int> isolated = machine.cpus("sys/devices/system/cpu/isolated");
  if (chosen.empty()) {
    return isolated.empty() ? fine("isolated CPUs", "there are none, and none are chosen by --cpus")
                            : fine("isolated CPUs",
                                   fmt::format("{}: only what names them in `cpus` runs there", cpu_list(isolated)));
  }
  std::vector<int> shared;
  std::set_difference(chosen.begin(), chosen.end(), isolated.begin(), isolated.end(), std::back_inserter(shared));
  return shared.empty() ? fine("isolated CPUs", fmt::format("{} are isolated", cpu_list(chosen)))
                        : bad("isolated CPUs", fmt::format("others may run on {}, too", cpu_list(shared)),
                              fmt::format("boot with isolcpus={0} nohz_full={0} rcu_nocbs={0}", cpu_list(chosen)));
}

MachineCheck check_allowed(const Machine& machine, const std::vector<int>& chosen) {
  const std::vector<int> present = present_cpus(machine);
  std::vector<int> missing;
  std::set_difference(chosen.begin(), chosen.end(), present.begin(), present.end(), std::back_inserter(missing));
  return missing.empty() ? fine("CPUs", fmt::format("{} are there", cpu_list(present)))
                         : bad("CPUs", fmt::format("this machine has no CPU {}", cpu_list(missing)),
                               fmt::format("its CPUs are {}", cpu_list(present)));
}

MachineCheck check_interrupts(const Machine& machine, const std::vector<int>& chosen) {
  if (chosen.empty()) {
    return fine("interrupts", "no CPUs are chosen, by --cpus or by isolation");
  }
  std::vector<int> there;
  for (const std::string& irq : machine.entries("proc/irq")) {
    std::vector<int> affinity = machine.cpus(fmt::format("proc/irq/{}/effective_affinity_list", irq));
    if (affinity.empty()) {
      affinity = machine.cpus(fmt::format("proc/irq/{}/smp_affinity_list", irq));
    }
    if (std::find_first_of(affinity.begin(), affinity.end(), chosen.begin(), chosen.end()) != affinity.end()) {
      there.push_back(std::atoi(irq.c_str()));
    }
  }
  std::sort(there.begin(), there.end());
  return there.empty()
             ? fine("interrupts", fmt::format("none comes to the CPUs {}", cpu_list(chosen)))
             : bad("interrupts",
                   fmt::format("those of the numbers {} come to the CPUs {}", cpu_list(there), cpu_list(chosen)),
                   "end irqbalance, and write other CPUs to /proc/irq/NUMBER/smp_affinity_list");
}

MachineCheck check_huge_pages(const Machine& machine) {
  const bool always = machine.line("sys/kernel/mm/transparent_hugepage/enabled").find("[always]") != std::string::npos;
  return always ? bad("huge pages", "transparent huge pages: always. The kernel moves memory for them at any time",
                      "echo madvise >/sys/kernel/mm/transparent_hugepage/enabled")
                : fine("huge pages", "transparent huge pages are not made for everybody");
}

MachineCheck check_swap(const Machine& machine) {
  const std::string swaps = machine.text("proc/swaps");
  const auto lines = std::count(swaps.begin(), swaps.end(), '\n');
  return lines > 1 ? bad("swap", "memory can be swapped out", "swapoff -a, or lock the memory in the program")
                   : fine("swap", "none");
}

MachineCheck check_clock(const Machine& machine) {
  const std::string clock = machine.line("sys/devices/system/clocksource/clocksource0/current_clocksource");
  const bool is_quick = clock.empty() || clock == "tsc" || clock == "kvm-clock" || clock == "arch_sys_counter" ||
                        clock == "hyperv_clocksource_tsc_page";
  return is_quick ? fine("clock", clock.empty() ? "unknown" : clock)
                  : bad("clock", fmt::format("{}: each look at the time is a system call", clock),
                        "boot with tsc=reliable, if the processors' counters are");
}

}  // namespace

std::vector<MachineCheck> check_real_time(const Machine& machine, std::vector<int> cpus) {
  if (cpus.empty()) {
    cpus = machine.cpus("sys/devices/system/cpu/isolated");
  }
  const std::vector<int> looked_at = cpus.empty() ? present_cpus(machine) : cpus;
  return {check_kernel(machine),
          check_allowed(machine, cpus),
          check_governor(machine, looked_at),
          check_idle_states(machine, looked_at),
          check_priority(machine),
          check_locked_memory(machine),
          check_throttling(machine),
          check_isolation(machine, cpus),
          check_interrupts(machine, cpus),
          check_huge_pages(machine),
          check_swap(machine),
          check_clock(machine)};
}

}  // namespace launch
