// SPDX-License-Identifier: Apache-2.0
#include "tracing/record/plan/context_fields.hpp"

#include <fmt/core.h>
#include <linux/perf_event.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <string_view>

#include "base/text/names.hpp"
#include "tracing/record/plan/trace_error.hpp"

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

enum class Available { kBoth, kUserspace, kKernel };

struct KnownField {
  std::string_view name;
  lttng_event_context_type type;
  Available available;
};

// lttng-add-context(1), LTTng 2.13.
constexpr std::array kKnownFields = {
    KnownField{"procname", LTTNG_EVENT_CONTEXT_PROCNAME, Available::kBoth},
    KnownField{"vpid", LTTNG_EVENT_CONTEXT_VPID, Available::kBoth},
    KnownField{"vtid", LTTNG_EVENT_CONTEXT_VTID, Available::kBoth},
    KnownField{"pthread_id", LTTNG_EVENT_CONTEXT_PTHREAD_ID, Available::kUserspace},
    KnownField{"ip", LTTNG_EVENT_CONTEXT_IP, Available::kUserspace},
    KnownField{"pid", LTTNG_EVENT_CONTEXT_PID, Available::kKernel},
    KnownField{"tid", LTTNG_EVENT_CONTEXT_TID, Available::kKernel},
    KnownField{"ppid", LTTNG_EVENT_CONTEXT_PPID, Available::kKernel},
    KnownField{"vppid", LTTNG_EVENT_CONTEXT_VPPID, Available::kKernel},
    KnownField{"hostname", LTTNG_EVENT_CONTEXT_HOSTNAME, Available::kKernel},
    KnownField{"prio", LTTNG_EVENT_CONTEXT_PRIO, Available::kKernel},
    KnownField{"nice", LTTNG_EVENT_CONTEXT_NICE, Available::kKernel},
    KnownField{"interruptible", LTTNG_EVENT_CONTEXT_INTERRUPTIBLE, Available::kKernel},
    KnownField{"preemptible", LTTNG_EVENT_CONTEXT_PREEMPTIBLE, Available::kKernel},
    KnownField{"need_reschedule", LTTNG_EVENT_CONTEXT_NEED_RESCHEDULE, Available::kKernel},
    KnownField{"migratable", LTTNG_EVENT_CONTEXT_MIGRATABLE, Available::kKernel},
    KnownField{"callstack-kernel", LTTNG_EVENT_CONTEXT_CALLSTACK_KERNEL, Available::kKernel},
    KnownField{"callstack-user", LTTNG_EVENT_CONTEXT_CALLSTACK_USER, Available::kKernel},
    KnownField{"uid", LTTNG_EVENT_CONTEXT_UID, Available::kKernel},
    KnownField{"euid", LTTNG_EVENT_CONTEXT_EUID, Available::kKernel},
    KnownField{"suid", LTTNG_EVENT_CONTEXT_SUID, Available::kKernel},
    KnownField{"gid", LTTNG_EVENT_CONTEXT_GID, Available::kKernel},
    KnownField{"egid", LTTNG_EVENT_CONTEXT_EGID, Available::kKernel},
    KnownField{"sgid", LTTNG_EVENT_CONTEXT_SGID, Available::kKernel},
    KnownField{"vuid", LTTNG_EVENT_CONTEXT_VUID, Available::kBoth},
    KnownField{"veuid", LTTNG_EVENT_CONTEXT_VEUID, Available::kBoth},
    KnownField{"vsuid", LTTNG_EVENT_CONTEXT_VSUID, Available::kBoth},
    KnownField{"vgid", LTTNG_EVENT_CONTEXT_VGID, Available::kBoth},
    KnownField{"vegid", LTTNG_EVENT_CONTEXT_VEGID, Available::kBoth},
    KnownField{"vsgid", LTTNG_EVENT_CONTEXT_VSGID, Available::kBoth},
    KnownField{"cgroup_ns", LTTNG_EVENT_CONTEXT_CGROUP_NS, Available::kBoth},
    KnownField{"ipc_ns", LTTNG_EVENT_CONTEXT_IPC_NS, Available::kBoth},
    KnownField{"mnt_ns", LTTNG_EVENT_CONTEXT_MNT_NS, Available::kBoth},
    KnownField{"net_ns", LTTNG_EVENT_CONTEXT_NET_NS, Available::kBoth},
    KnownField{"pid_ns", LTTNG_EVENT_CONTEXT_PID_NS, Available::kBoth},
    KnownField{"time_ns", LTTNG_EVENT_CONTEXT_TIME_NS, Available::kBoth},
    KnownField{"user_ns", LTTNG_EVENT_CONTEXT_USER_NS, Available::kBoth},
    KnownField{"uts_ns", LTTNG_EVENT_CONTEXT_UTS_NS, Available::kBoth},
};

bool exists_in(Available available, lttng_domain_type domain) {
  return available == Available::kBoth ||
         available == (domain == LTTNG_DOMAIN_KERNEL ? Available::kKernel : Available::kUserspace);
}

std::string_view events_of(lttng_domain_type domain) {
  return domain == LTTNG_DOMAIN_KERNEL ? "kernel events" : "userspace events";
}

std::string suggestion(std::string_view name, lttng_domain_type domain) {
  const std::string nearest = launch::nearest_name(name, context_field_names(domain));
  return nearest.empty() ? "lttng-add-context(1) lists the context fields" : fmt::format("did you mean `{}`?", nearest);
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

std::vector<std::string> context_field_names(lttng_domain_type domain) {
  std::vector<std::string> names;
  for (const KnownField& field : kKnownFields) {
    if (exists_in(field.available, domain)) {
      names.emplace_back(field.name);
    }
  }
  return names;
}

ContextField::ContextField(const std::string& name, lttng_domain_type domain) {
  if (name.starts_with("perf:")) {
    set_perf_counter(name, domain);
  } else if (name.starts_with("$app.")) {
    set_application_context(name);
  } else {
    set_known_field(name, domain);
  }
}

void ContextField::set_known_field(const std::string& name, lttng_domain_type domain) {
  const auto known = std::find_if(kKnownFields.begin(), kKnownFields.end(),
                                  [&](const KnownField& field) { return field.name == name; });
  if (known == kKnownFields.end()) {
    throw TraceError(fmt::format("unknown context field '{}'", name), suggestion(name, domain));
  }
  if (!exists_in(known->available, domain)) {
    throw TraceError(fmt::format("context field '{}' does not exist for {}", name, events_of(domain)),
                     suggestion(name, domain));
  }
  context_.ctx = known->type;
}

// "perf:thread:COUNTER" (userspace) or "perf:cpu:COUNTER" (kernel).
void ContextField::set_perf_counter(const std::string& name, lttng_domain_type domain) {
  const bool kernel = domain == LTTNG_DOMAIN_KERNEL;
  const std::string_view prefix = kernel ? "perf:cpu:" : "perf:thread:";
  if (!name.starts_with(prefix)) {
    throw TraceError(fmt::format("context field '{}' does not exist for {}", name, events_of(domain)),
                     fmt::format("there it is `{}COUNTER`", prefix));
  }
  const auto counter = find_perf_counter(name.substr(prefix.size()));
  if (!counter) {
    throw TraceError(fmt::format("unknown performance counter in context field '{}'", name),
                     "lttng-add-context(1) lists them; raw ones are written raw:rN:NAME");
  }
  context_.ctx = kernel ? LTTNG_EVENT_CONTEXT_PERF_CPU_COUNTER : LTTNG_EVENT_CONTEXT_PERF_THREAD_COUNTER;
  context_.u.perf_counter.type = counter->type;
  context_.u.perf_counter.config = counter->config;
  std::string field = fmt::format("perf_{}_{}", kernel ? "cpu" : "thread", counter->name);
  std::replace(field.begin(), field.end(), '-', '_');
  field.copy(context_.u.perf_counter.name, sizeof context_.u.perf_counter.name - 1);
}

// "$app.PROVIDER:TYPE"
void ContextField::set_application_context(const std::string& name) {
  const std::size_t provider = name.find('.') + 1;
  const std::size_t colon = name.find(':', provider);
  if (colon == std::string::npos || colon == provider || colon + 1 == name.size()) {
    throw TraceError(fmt::format("malformed context field '{}'", name), "write it as $app.PROVIDER:TYPE");
  }
  application_provider_ = name.substr(provider, colon - provider);
  application_type_ = name.substr(colon + 1);
  context_.ctx = LTTNG_EVENT_CONTEXT_APP_CONTEXT;
  context_.u.app_ctx.provider_name = application_provider_.data();
  context_.u.app_ctx.ctx_name = application_type_.data();
}

}  // namespace tracing
