// SPDX-License-Identifier: Apache-2.0
// What LTTng's kernel modules can record, and what they would get wrong. All throw TraceError.
#pragma once

#include <string>
#include <vector>

#include "tracing/plan/channel_plan.hpp"

namespace tracing {

// Events of the kernel can be recorded: its modules are there and this user may use them. Needs a session daemon.
void check_kernel_tracer();

// Of the modules that are loaded, "2.13.9"; empty when none are.
std::string kernel_modules_version();

// Names of tracepoints and of system calls. Need check_kernel_tracer() to have succeeded.
std::vector<std::string> kernel_event_names();
std::vector<std::string> syscall_names();

// Takes the names that mean nothing out of the kernel channels, and channels that have none left out of `channels`:
// LTTng takes any name, and records nothing for one that isn't. Returns a warning that names them, "" when there are
// none. Throws when nothing is left.
std::string drop_unknown_kernel_names(std::vector<ChannelPlan>& channels, const std::vector<std::string>& events,
                                      const std::vector<std::string>& syscalls);

// No context field of a kernel channel is one with which this version of the modules crashes the kernel.
void check_kernel_context_fields(const std::vector<ChannelPlan>& channels, const std::string& modules_version);

}  // namespace tracing
