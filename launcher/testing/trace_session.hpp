// SPDX-License-Identifier: Apache-2.0
// The recording of a test that expects something of its trace.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "launcher/language/launch_description.hpp"
#include "launcher/language/registry.hpp"

namespace launch {

// Where the trace of a test is, below its directory.
std::string trace_directory(const std::string& directory);
// Where the traces are that the launch file itself records, unless it says so.
std::string own_trace_directory(const std::string& directory);

// The description with a <trace> of its own, whose session no other run has. It records ROS 2's events and the others
// that are named.
std::shared_ptr<const LaunchDescription> recorded(const LaunchDescription& description, const Registry& registry,
                                                  const std::string& directory,
                                                  const std::vector<std::string>& other_events);

}  // namespace launch
