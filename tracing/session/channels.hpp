// The channel of each domain, with the attributes of ros2_tracing, and what is recorded into it.
#pragma once

#include <lttng/domain.h>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "tracing/session/trace_config.hpp"

struct lttng_handle;

namespace tracing {

struct HandleDeleter {
  void operator()(lttng_handle* handle) const;
};
using DomainHandle = std::unique_ptr<lttng_handle, HandleDeleter>;

// Names a session and one of its domains to liblttng-ctl. Userspace buffers are shared per user id.
DomainHandle domain_handle(const std::string& lttng_session_name, lttng_domain_type domain);
// The same for a domain as the daemon lists it, whose buffers may be of another kind.
DomainHandle domain_handle(const std::string& lttng_session_name, lttng_domain domain);

// "ust" or "kernel".
std::string domain_name(lttng_domain_type domain);

// One channel of a session and everything that is recorded into it. A domain has one, userspace two with
// `init_channel`.
struct DomainPlan {
  lttng_domain_type domain = LTTNG_DOMAIN_UST;
  std::string channel;
  std::vector<std::string> events;
  std::vector<std::string> syscalls;
  std::vector<std::string> context_fields;
  std::uint64_t subbuffer_size = 0;  // bytes
  std::uint64_t subbuffer_count = 2;
  std::uint32_t read_timer = 200;  // µs
  std::uint32_t switch_timer = 0;  // µs
  bool overwrite = false;          // keep the newest events rather than the oldest: what a snapshot needs
};

// The channels into which `config` records something; names that occur twice are taken once. Warnings (a sub-buffer
// size that had to be rounded up) are appended. Throws TraceError for a context field that can't be had.
std::vector<DomainPlan> plan_domains(const TraceConfig& config, std::vector<std::string>& warnings);

// The steps of setting a domain up, in this order. Each throws TraceError.
void enable_channel(const std::string& lttng_session_name, const DomainPlan& plan);
void enable_events(const std::string& lttng_session_name, const DomainPlan& plan);
void add_contexts(const std::string& lttng_session_name, const DomainPlan& plan);

}  // namespace tracing
