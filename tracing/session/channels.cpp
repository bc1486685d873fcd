#include "tracing/session/channels.hpp"

#include <fmt/core.h>
#include <lttng/lttng.h>
#include <unistd.h>

#include <algorithm>
#include <bit>
#include <set>

#include "tracing/session/context_fields.hpp"
#include "tracing/session/lttng_error.hpp"

namespace tracing {
namespace {

constexpr const char* kUserspaceChannel = "ros2";
constexpr const char* kInitialisationChannel = "ros2_init";
constexpr const char* kAllRosEvents = "ros2:*";
constexpr const char* kKernelChannel = "kchan";
constexpr unsigned int kKernelReadTimer = 200;  // µs: the consumer polls, nobody has to wake it
constexpr std::uint64_t kFewestSubbuffers = 2;
constexpr std::uint64_t kMostSubbuffers = std::uint64_t{1} << 20;
constexpr std::uint64_t kLargestSubbuffer = std::uint64_t{1} << 40;

lttng_domain make_domain(lttng_domain_type type) {
  lttng_domain domain{};
  domain.type = type;
  domain.buf_type = type == LTTNG_DOMAIN_KERNEL ? LTTNG_BUFFER_GLOBAL : LTTNG_BUFFER_PER_UID;
  return domain;
}

std::vector<std::string> without_repetitions(const std::vector<std::string>& names) {
  std::vector<std::string> unique;
  std::set<std::string> seen;
  for (const std::string& name : names) {
    if (seen.insert(name).second) unique.push_back(name);
  }
  return unique;
}

// LTTng refuses sizes that are no power of two or less than a page.
std::uint64_t usable_subbuffer_size(std::uint64_t given, lttng_domain_type domain, std::vector<std::string>& warnings) {
  if (given > kLargestSubbuffer) {
    throw TraceError(
        fmt::format("sub-buffer size of {} bytes for the {} domain is too large", given, domain_name(domain)));
  }
  const std::uint64_t usable = std::bit_ceil(std::max<std::uint64_t>(given, static_cast<std::uint64_t>(getpagesize())));
  if (usable != given) {
    warnings.push_back(
        fmt::format("sub-buffer size of {} bytes for the {} domain is rounded up to {}: LTTng needs a "
                    "power of two, at least a page",
                    given, domain_name(domain), usable));
  }
  return usable;
}

// A power of two, and two at least: one is written to while the other is read.
std::uint64_t usable_subbuffer_count(const TraceConfig& config, std::vector<std::string>& warnings) {
  const std::uint64_t given = config.subbuffer_count_ust;
  if (given == 0) return config.default_subbuffer_count();
  if (given > kMostSubbuffers)
    throw TraceError(fmt::format("{} sub-buffers are too many: {} are possible", given, kMostSubbuffers));
  const std::uint64_t usable = std::bit_ceil(std::max(given, kFewestSubbuffers));
  if (usable != given) {
    warnings.push_back(fmt::format(
        "number of sub-buffers {} is rounded up to {}: LTTng needs a power of two, at least 2", given, usable));
  }
  return usable;
}

// Moves the initialisation events of the userspace channel, which is the first plan, to a channel of their own. A
// pattern other than "ros2:*" stays where it is: an event that two rules match would be recorded twice.
void split_initialisation_events(std::vector<DomainPlan>& plans) {
  const std::vector<std::string>& all = initialisation_ros_events();
  const std::set<std::string> initialisation(all.begin(), all.end());
  DomainPlan first = plans.front();
  first.channel = kInitialisationChannel;
  first.events.clear();
  std::vector<std::string> rest;
  for (const std::string& name : plans.front().events) {
    const std::vector<std::string> names = name == kAllRosEvents ? default_ros_events() : std::vector{name};
    for (const std::string& event : names) (initialisation.contains(event) ? first.events : rest).push_back(event);
  }
  first.events = without_repetitions(first.events);
  plans.front().events = without_repetitions(rest);
  if (rest.empty()) plans.erase(plans.begin());
  if (!first.events.empty()) plans.insert(plans.begin(), std::move(first));
}

void enable_event(lttng_handle* handle, const std::string& name, lttng_event_type type, const std::string& channel) {
  lttng_event event{};
  if (name.empty() || name.size() >= sizeof event.name) {
    throw TraceError(fmt::format("event name '{}' has {} characters: 1 to {} are possible", name, name.size(),
                                 sizeof event.name - 1));
  }
  name.copy(event.name, name.size());
  event.type = type;
  event.loglevel_type = LTTNG_EVENT_LOGLEVEL_ALL;
  const char* kind = type == LTTNG_EVENT_SYSCALL ? "system call" : "event";
  check_lttng(lttng_enable_event(handle, &event, channel.c_str()), fmt::format("enable {} '{}'", kind, name));
}

}  // namespace

void HandleDeleter::operator()(lttng_handle* handle) const {
  lttng_destroy_handle(handle);
}

DomainHandle domain_handle(const std::string& lttng_session_name, lttng_domain_type type) {
  return domain_handle(lttng_session_name, make_domain(type));
}

DomainHandle domain_handle(const std::string& lttng_session_name, lttng_domain domain) {
  DomainHandle handle(lttng_create_handle(lttng_session_name.c_str(), &domain));
  if (!handle) throw lttng_error(LTTNG_ERR_NOMEM, "reach a tracing domain");
  return handle;
}

std::string domain_name(lttng_domain_type domain) {
  return domain == LTTNG_DOMAIN_KERNEL ? "kernel" : "ust";
}

std::vector<DomainPlan> plan_domains(const TraceConfig& config, std::vector<std::string>& warnings) {
  std::vector<DomainPlan> plans;
  if (!config.events_ust.empty()) {
    plans.push_back({.domain = LTTNG_DOMAIN_UST,
                     .channel = kUserspaceChannel,
                     .events = without_repetitions(config.events_ust),
                     .syscalls = {},
                     .context_fields = without_repetitions(config.context_fields_ust),
                     .subbuffer_size = usable_subbuffer_size(config.subbuffer_size_ust, LTTNG_DOMAIN_UST, warnings),
                     .subbuffer_count = usable_subbuffer_count(config, warnings),
                     .read_timer = config.read_timer_ust,
                     .switch_timer = config.switch_timer_ust,
                     .overwrite = config.records_snapshots()});
  }
  if (!config.events_kernel.empty() || !config.syscalls.empty()) {
    plans.push_back(
        {.domain = LTTNG_DOMAIN_KERNEL,
         .channel = kKernelChannel,
         .events = without_repetitions(config.events_kernel),
         .syscalls = without_repetitions(config.syscalls),
         .context_fields = without_repetitions(config.context_fields_kernel),
         .subbuffer_size = usable_subbuffer_size(config.subbuffer_size_kernel, LTTNG_DOMAIN_KERNEL, warnings),
         .subbuffer_count = config.default_subbuffer_count(),
         .read_timer = kKernelReadTimer,
         .overwrite = config.records_snapshots()});
  }
  if (config.init_channel && !config.events_ust.empty()) split_initialisation_events(plans);
  for (const DomainPlan& plan : plans) {
    for (const std::string& name : plan.context_fields) ContextField{name, plan.domain};
  }
  return plans;
}

void enable_channel(const std::string& lttng_session_name, const DomainPlan& plan) {
  lttng_domain domain = make_domain(plan.domain);
  const std::unique_ptr<lttng_channel, decltype(&lttng_channel_destroy)> channel(lttng_channel_create(&domain),
                                                                                 &lttng_channel_destroy);
  if (!channel) throw lttng_error(LTTNG_ERR_NOMEM, "create a channel");
  plan.channel.copy(channel->name, sizeof channel->name - 1);
  channel->attr.overwrite = plan.overwrite ? 1 : 0;
  channel->attr.subbuf_size = plan.subbuffer_size;
  channel->attr.num_subbuf = plan.subbuffer_count;
  channel->attr.switch_timer_interval = plan.switch_timer;
  channel->attr.read_timer_interval = plan.read_timer;
  channel->attr.output = LTTNG_EVENT_MMAP;
  const DomainHandle handle = domain_handle(lttng_session_name, plan.domain);
  check_lttng(lttng_enable_channel(handle.get(), channel.get()),
              fmt::format("create {} channel '{}'", domain_name(plan.domain), plan.channel));
}

void enable_events(const std::string& lttng_session_name, const DomainPlan& plan) {
  const DomainHandle handle = domain_handle(lttng_session_name, plan.domain);
  for (const std::string& name : plan.events) enable_event(handle.get(), name, LTTNG_EVENT_TRACEPOINT, plan.channel);
  for (const std::string& name : plan.syscalls) enable_event(handle.get(), name, LTTNG_EVENT_SYSCALL, plan.channel);
}

void add_contexts(const std::string& lttng_session_name, const DomainPlan& plan) {
  const DomainHandle handle = domain_handle(lttng_session_name, plan.domain);
  for (const std::string& name : plan.context_fields) {
    ContextField field(name, plan.domain);
    check_lttng(lttng_add_context(handle.get(), field.get(), nullptr, plan.channel.c_str()),
                fmt::format("add context field '{}' to the {} domain", name, domain_name(plan.domain)));
  }
}

}  // namespace tracing
