// SPDX-License-Identifier: Apache-2.0
#include "tracing/record/lttng/channels.hpp"

#include <fmt/core.h>
#include <lttng/event.h>

#include <algorithm>
#include <vector>

#include "tracing/record/lttng/lttng_ctl.hpp"
#include "tracing/record/lttng/lttng_error.hpp"
#include "tracing/record/plan/context_fields.hpp"
#include "tracing/record/plan/event_rule.hpp"
#include "tracing/record/plan/trace_config.hpp"
#include "tracing/record/plan/trace_error.hpp"

namespace tracing {
namespace {

lttng_domain make_domain(lttng_domain_type type, BufferOwner owner) {
  lttng_domain domain{};
  domain.type = type;
  domain.buf_type = owner == BufferOwner::kProcess ? LTTNG_BUFFER_PER_PID : LTTNG_BUFFER_PER_UID;
  if (type == LTTNG_DOMAIN_KERNEL) {
    domain.buf_type = LTTNG_BUFFER_GLOBAL;
  }
  return domain;
}

DomainHandle domain_of(const std::string& lttng_session_name, const ChannelPlan& plan) {
  return domain_handle(lttng_session_name, make_domain(plan.domain, plan.buffers));
}

struct EventDeleter {
  void operator()(lttng_event* event) const { lttng_event_destroy(event); }
};
using EventPtr = std::unique_ptr<lttng_event, EventDeleter>;

EventPtr make_event(const std::string& name, lttng_event_type type) {
  EventPtr event(lttng_event_create());
  if (!event) {
    throw lttng_error(LTTNG_ERR_NOMEM, "describe an event");
  }
  name.copy(event->name, sizeof event->name - 1);
  event->type = type;
  event->loglevel_type = LTTNG_EVENT_LOGLEVEL_ALL;
  return event;
}

void enable_event(lttng_handle* handle, const EventRule& rule, const std::string& channel) {
  const EventPtr event = make_event(rule.pattern, LTTNG_EVENT_TRACEPOINT);
  if (rule.log_level) {
    event->loglevel_type = rule.exactly_that_level ? LTTNG_EVENT_LOGLEVEL_SINGLE : LTTNG_EVENT_LOGLEVEL_RANGE;
    event->loglevel = *rule.log_level;
  }
  const int result = lttng_enable_event_with_filter(handle, event.get(), channel.c_str(),
                                                    rule.filter.empty() ? nullptr : rule.filter.c_str());
  if (result == -LTTNG_ERR_FILTER_INVAL) {
    throw TraceError(fmt::format("LTTng does not understand the filter of event '{}': {}", rule.pattern, rule.filter),
                     "lttng-enable-event(1) describes filter expressions");
  }
  check_lttng(result, fmt::format("enable event '{}'", rule.pattern));
}

void enable_syscall(lttng_handle* handle, const std::string& name, const std::string& channel) {
  const EventPtr event = make_event(name, LTTNG_EVENT_SYSCALL);
  check_lttng(lttng_enable_event(handle, event.get(), channel.c_str()), fmt::format("enable system call '{}'", name));
}

}  // namespace

void HandleDeleter::operator()(lttng_handle* handle) const {
  lttng_destroy_handle(handle);
}

DomainHandle domain_handle(const std::string& lttng_session_name, lttng_domain_type type) {
  return domain_handle(lttng_session_name, make_domain(type, BufferOwner::kUser));
}

DomainHandle domain_handle(const std::string& lttng_session_name, lttng_domain domain) {
  DomainHandle handle(lttng_create_handle(lttng_session_name.c_str(), &domain));
  if (!handle) {
    throw lttng_error(LTTNG_ERR_NOMEM, "reach a tracing domain");
  }
  return handle;
}

void enable_channel(const std::string& lttng_session_name, const ChannelPlan& plan) {
  lttng_domain domain = make_domain(plan.domain, plan.buffers);
  const LttngOwned<lttng_channel> channel(lttng_channel_create(&domain), lttng_channel_destroy);
  if (!channel) {
    throw lttng_error(LTTNG_ERR_NOMEM, "create a channel");
  }
  plan.channel.copy(channel->name, sizeof channel->name - 1);
  channel->enabled = 1;
  channel->attr.overwrite = plan.overwrite ? 1 : 0;
  channel->attr.subbuf_size = plan.subbuffer_size;
  channel->attr.num_subbuf = plan.subbuffer_count;
  channel->attr.switch_timer_interval = plan.switch_timer;
  channel->attr.read_timer_interval = plan.read_timer;
  channel->attr.output = LTTNG_EVENT_MMAP;
  channel->attr.tracefile_size = plan.tracefile_size;
  channel->attr.tracefile_count = plan.tracefile_count;
  const std::string doing = fmt::format("create {} channel '{}'", domain_name(plan.domain), plan.channel);
  if (plan.blocking_timeout != 0) {
    check_lttng(lttng_channel_set_blocking_timeout(channel.get(), plan.blocking_timeout), doing);
  }
  const DomainHandle handle = domain_of(lttng_session_name, plan);
  check_lttng(lttng_enable_channel(handle.get(), channel.get()), doing);
}

void enable_events(const std::string& lttng_session_name, const ChannelPlan& plan) {
  lttng_domain domain = make_domain(plan.domain, plan.buffers);
  if (plan.python) {
    domain.type = LTTNG_DOMAIN_PYTHON;  // LTTng makes an event of userspace of it, and takes its channel by name
  }
  const DomainHandle handle = domain_handle(lttng_session_name, domain);
  for (const EventRule& rule : plan.events) {
    enable_event(handle.get(), rule, plan.channel);
  }
  for (const std::string& name : plan.syscalls) {
    enable_syscall(handle.get(), name, plan.channel);
  }
}

void add_contexts(const std::string& lttng_session_name, const ChannelPlan& plan) {
  const DomainHandle handle = domain_of(lttng_session_name, plan);
  for (const std::string& name : plan.context_fields) {
    ContextField field(name, plan.domain);
    check_lttng(lttng_add_context(handle.get(), field.get(), nullptr, plan.channel.c_str()),
                fmt::format("add context field '{}' to the {} domain", name, domain_name(plan.domain)));
  }
}

}  // namespace tracing
