// SPDX-License-Identifier: Apache-2.0
// Results of tests for other programs: JUnit XML, TAP, JSON, annotations of GitHub.
#pragma once

#include <string>
#include <vector>

#include "launcher/testing/test_result.hpp"

namespace launch {

// <testsuites> with a <testsuite> for each launch file, as build servers read it.
std::string as_junit(const std::vector<TestResult>& results);
// The Test Anything Protocol, version 13.
std::string as_tap(const std::vector<TestResult>& results);
std::string as_json(const std::vector<TestResult>& results);
// Commands of a workflow of GitHub, a line for each failure, which shows it at its line of the launch file. Paths are
// relative to `directory` where they are below it.
std::string as_github(const std::vector<TestResult>& results, const std::string& directory);

}  // namespace launch
