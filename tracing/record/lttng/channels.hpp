// SPDX-License-Identifier: Apache-2.0
// Sets the channels of a session up at the session daemon.
#pragma once

#include <lttng/domain.h>

#include <memory>
#include <string>

#include "tracing/record/plan/channel_plan.hpp"

struct lttng_handle;

namespace tracing {

struct HandleDeleter {
  void operator()(lttng_handle* handle) const;
};
using DomainHandle = std::unique_ptr<lttng_handle, HandleDeleter>;

// Names a session and one of its domains to liblttng-ctl.
DomainHandle domain_handle(const std::string& lttng_session_name, lttng_domain domain);
// Whether LTTng lists channels of the domain. Those of Python's loggers are among the channels of userspace.
inline bool has_channels(const lttng_domain& domain) {
  return domain.type == LTTNG_DOMAIN_UST || domain.type == LTTNG_DOMAIN_KERNEL;
}
// For calls that work alike for buffers of users and buffers of processes.
DomainHandle domain_handle(const std::string& lttng_session_name, lttng_domain_type domain);

// The steps of setting a channel up, in this order. Each throws TraceError.
void enable_channel(const std::string& lttng_session_name, const ChannelPlan& plan);
void enable_events(const std::string& lttng_session_name, const ChannelPlan& plan);
void add_contexts(const std::string& lttng_session_name, const ChannelPlan& plan);

}  // namespace tracing
