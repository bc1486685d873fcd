// SPDX-License-Identifier: Apache-2.0
// Checks of LTTng's kernel modules: the events that they can record, and known faults. Each function throws TraceError.
#pragma once

#include <string>
#include <vector>

#include "tracing/record/plan/channel_plan.hpp"

namespace tracing {

// Events of the kernel can be recorded: its modules are there and this user may use them. Needs a session daemon.
void check_kernel_tracer();

// The version of the loaded modules, "2.13.9"; "" when none are loaded.
std::string kernel_modules_version();

// Names of tracepoints and of system calls. Need check_kernel_tracer() to have succeeded.
std::vector<std::string> kernel_event_names();
std::vector<std::string> syscall_names();

// Removes the names that the kernel does not have from the kernel channels of `channels`, and the channels that have no
// name left. LTTng accepts any name, and records nothing for one that does not exist. Returns a warning with these
// names, "" when there are none. Throws when no name is left.
std::string drop_unknown_kernel_names(std::vector<ChannelPlan>& channels, const std::vector<std::string>& events,
                                      const std::vector<std::string>& syscalls);

// Throws if a kernel channel has a context field with which this version of the modules crashes the kernel.
void check_kernel_context_fields(const std::vector<ChannelPlan>& channels, const std::string& modules_version);

}  // namespace tracing
