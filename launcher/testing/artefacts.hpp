// SPDX-License-Identifier: Apache-2.0
// What a test leaves beside its logs: the trace of which it expects something, and, when it has failed, pages of its
// traces and bundles of its crashes for a person.
#pragma once

#include <sys/types.h>

#include <memory>
#include <string>
#include <vector>

#include "launcher/language/launch_description.hpp"
#include "launcher/language/registry.hpp"
#include "launcher/process/process_spec.hpp"
#include "launcher/visit/test_request.hpp"

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

// Where the bundles of crashes are (launcher/crash/crash_bundle.hpp).
std::string crash_directory(const std::string& directory);

// An end that the test expects gets no bundle, and leaves no core.
void expect_no_crash_bundle(const std::vector<Expectation>& expectations, ProcessSpec& spec);

// Writes `report.html` beside each trace of the test in its directory, of the events of these processes. A trace of
// which no page can be made has a file `report.txt` that says why.
void write_reports(const std::string& directory, const std::vector<pid_t>& processes);

}  // namespace launch
