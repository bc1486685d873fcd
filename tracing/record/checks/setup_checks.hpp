// SPDX-License-Identifier: Apache-2.0
// Checks before a session is created. Each throws TraceError.
#pragma once

#include <cstdint>
#include <string>

#include "tracing/record/plan/trace_config.hpp"

namespace tracing {

// The session's name can be one, something is to be recorded, and the trace directory is free and can be created.
void check_config(const TraceConfig& config);

// The base directory, or what exists of the path to it, is a directory where this user may write.
void check_writable(const std::string& base_path);

// Bytes that the buffers of userspace channels can take: the free space of /dev/shm. Throws when it can't be written.
std::uint64_t free_shared_memory();

}  // namespace tracing
