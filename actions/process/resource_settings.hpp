// SPDX-License-Identifier: Apache-2.0
// The attributes of <executable> and <node> for the scheduling and limits of a process: a row for each.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "launcher/language/setting.hpp"
#include "launcher/process/resource_limits.hpp"

namespace launch {

// An amount of memory: "1500000", "64K", "512M", "2G". Throws LaunchError at `where`; `or_else` ends its help.
std::uint64_t parse_bytes(const std::string& text, const SourceRange& where, const char* or_else = "");
// Time of processors: "50%" is 0.5 of one. Throws LaunchError at `where`.
double parse_share(const std::string& text, const SourceRange& where);

const std::vector<Setting<ResourceLimits>>& resource_settings();

// Throws LaunchError at the place if values that are evaluated don't go together.
void check_resources(const Fields& fields, const ResourceLimits& limits);

}  // namespace launch
