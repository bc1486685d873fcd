// SPDX-License-Identifier: Apache-2.0
// What a test that has failed leaves for a person, beside its logs: pages of its traces, and bundles of its crashes.
#pragma once

#include <sys/types.h>

#include <string>
#include <vector>

#include "launcher/process/process_spec.hpp"
#include "launcher/visit/test_request.hpp"

namespace launch {

// Where the bundles of crashes are (launcher/crash/crash_bundle.hpp).
std::string crash_directory(const std::string& directory);

// An end that the test expects gets no bundle, and leaves no core.
void expect_no_crash_bundle(const std::vector<Expectation>& expectations, ProcessSpec& spec);

// Writes `report.html` beside each trace of the test in its directory, of the events of these processes. A trace of
// which no page can be made has a file `report.txt` that says why.
void write_reports(const std::string& directory, const std::vector<pid_t>& processes);

}  // namespace launch
