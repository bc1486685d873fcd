// SPDX-License-Identifier: Apache-2.0
#include "tracing/record/plan/perf_counters.hpp"

#include <linux/perf_event.h>

#include <array>
#include <charconv>
#include <string_view>

namespace tracing {
namespace {

struct KnownCounter {
  std::string_view name;
  std::uint32_t type;
  std::uint64_t config;
};

constexpr std::array kCounters = {
    KnownCounter{"cpu-cycles", PERF_TYPE_HARDWARE, PERF_COUNT_HW_CPU_CYCLES},
    KnownCounter{"cycles", PERF_TYPE_HARDWARE, PERF_COUNT_HW_CPU_CYCLES},
    KnownCounter{"stalled-cycles-frontend", PERF_TYPE_HARDWARE, PERF_COUNT_HW_STALLED_CYCLES_FRONTEND},
    KnownCounter{"idle-cycles-frontend", PERF_TYPE_HARDWARE, PERF_COUNT_HW_STALLED_CYCLES_FRONTEND},
    KnownCounter{"stalled-cycles-backend", PERF_TYPE_HARDWARE, PERF_COUNT_HW_STALLED_CYCLES_BACKEND},
    KnownCounter{"idle-cycles-backend", PERF_TYPE_HARDWARE, PERF_COUNT_HW_STALLED_CYCLES_BACKEND},
    KnownCounter{"instructions", PERF_TYPE_HARDWARE, PERF_COUNT_HW_INSTRUCTIONS},
    KnownCounter{"cache-references", PERF_TYPE_HARDWARE, PERF_COUNT_HW_CACHE_REFERENCES},
    KnownCounter{"cache-misses", PERF_TYPE_HARDWARE, PERF_COUNT_HW_CACHE_MISSES},
    KnownCounter{"branch-instructions", PERF_TYPE_HARDWARE, PERF_COUNT_HW_BRANCH_INSTRUCTIONS},
    KnownCounter{"branches", PERF_TYPE_HARDWARE, PERF_COUNT_HW_BRANCH_INSTRUCTIONS},
    KnownCounter{"branch-misses", PERF_TYPE_HARDWARE, PERF_COUNT_HW_BRANCH_MISSES},
    KnownCounter{"bus-cycles", PERF_TYPE_HARDWARE, PERF_COUNT_HW_BUS_CYCLES},
    KnownCounter{"cpu-clock", PERF_TYPE_SOFTWARE, PERF_COUNT_SW_CPU_CLOCK},
    KnownCounter{"task-clock", PERF_TYPE_SOFTWARE, PERF_COUNT_SW_TASK_CLOCK},
    KnownCounter{"page-fault", PERF_TYPE_SOFTWARE, PERF_COUNT_SW_PAGE_FAULTS},
    KnownCounter{"faults", PERF_TYPE_SOFTWARE, PERF_COUNT_SW_PAGE_FAULTS},
    KnownCounter{"major-faults", PERF_TYPE_SOFTWARE, PERF_COUNT_SW_PAGE_FAULTS_MAJ},
    KnownCounter{"minor-faults", PERF_TYPE_SOFTWARE, PERF_COUNT_SW_PAGE_FAULTS_MIN},
    KnownCounter{"context-switches", PERF_TYPE_SOFTWARE, PERF_COUNT_SW_CONTEXT_SWITCHES},
    KnownCounter{"cs", PERF_TYPE_SOFTWARE, PERF_COUNT_SW_CONTEXT_SWITCHES},
    KnownCounter{"cpu-migrations", PERF_TYPE_SOFTWARE, PERF_COUNT_SW_CPU_MIGRATIONS},
    KnownCounter{"migrations", PERF_TYPE_SOFTWARE, PERF_COUNT_SW_CPU_MIGRATIONS},
    KnownCounter{"alignment-faults", PERF_TYPE_SOFTWARE, PERF_COUNT_SW_ALIGNMENT_FAULTS},
    KnownCounter{"emulation-faults", PERF_TYPE_SOFTWARE, PERF_COUNT_SW_EMULATION_FAULTS},
};

struct NamedNumber {
  std::string_view name;
  std::uint64_t number;
};

constexpr std::array kCaches = {
    NamedNumber{"L1-dcache-", PERF_COUNT_HW_CACHE_L1D}, NamedNumber{"L1-icache-", PERF_COUNT_HW_CACHE_L1I},
    NamedNumber{"LLC-", PERF_COUNT_HW_CACHE_LL},        NamedNumber{"dTLB-", PERF_COUNT_HW_CACHE_DTLB},
    NamedNumber{"iTLB-", PERF_COUNT_HW_CACHE_ITLB},     NamedNumber{"branch-", PERF_COUNT_HW_CACHE_BPU},
};

// Operation in the lowest byte, result in the next one.
constexpr std::array kCacheOperations = {
    NamedNumber{"loads", PERF_COUNT_HW_CACHE_OP_READ},
    NamedNumber{"load-misses", PERF_COUNT_HW_CACHE_OP_READ | PERF_COUNT_HW_CACHE_RESULT_MISS << 8},
    NamedNumber{"stores", PERF_COUNT_HW_CACHE_OP_WRITE},
    NamedNumber{"store-misses", PERF_COUNT_HW_CACHE_OP_WRITE | PERF_COUNT_HW_CACHE_RESULT_MISS << 8},
    NamedNumber{"prefetches", PERF_COUNT_HW_CACHE_OP_PREFETCH},
    NamedNumber{"prefetch-misses", PERF_COUNT_HW_CACHE_OP_PREFETCH | PERF_COUNT_HW_CACHE_RESULT_MISS << 8},
};

std::optional<PerfCounter> find_cache_counter(const std::string& name) {
  for (const NamedNumber& cache : kCaches) {
    if (!name.starts_with(cache.name)) {
      continue;
    }
    for (const NamedNumber& operation : kCacheOperations) {
      if (name.substr(cache.name.size()) == operation.name) {
        return PerfCounter{name, PERF_TYPE_HW_CACHE, cache.number | operation.number << 8};
      }
    }
  }
  return std::nullopt;
}

// "raw:rN:NAME", N in hexadecimal.
std::optional<PerfCounter> parse_raw_counter(std::string_view name) {
  name.remove_prefix(std::string_view("raw:r").size());
  PerfCounter counter{.name = {}, .type = PERF_TYPE_RAW, .config = 0};
  const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), counter.config, 16);
  name.remove_prefix(static_cast<std::size_t>(end - name.data()));
  if (error != std::errc() || name.size() < 2 || name.front() != ':') {
    return std::nullopt;
  }
  counter.name = name.substr(1);
  return counter;
}

}  // namespace

std::optional<PerfCounter> find_perf_counter(const std::string& name) {
  if (name.starts_with("raw:r")) {
    return parse_raw_counter(name);
  }
  for (const KnownCounter& counter : kCounters) {
    if (counter.name == name) {
      return PerfCounter{name, counter.type, counter.config};
    }
  }
  return find_cache_counter(name);
}

}  // namespace tracing
