// SPDX-License-Identifier: Apache-2.0
// Files of ROS 2's launch_testing, which the program launch_test runs (docs/launch_testing.md).
#pragma once

#include <string>
#include <vector>

#include "launcher/testing/test_files.hpp"

namespace launch {

// Whether the file is one: Python with generate_test_description().
bool is_launch_testing_file(const std::string& path);

// Becomes launch_test with these files and arguments. `junit` is the file for the results; empty: none. Returns only by
// throwing std::system_error.
[[noreturn]] void run_launch_testing_files(const std::vector<std::string>& files, const LaunchArguments& arguments,
                                           const std::string& junit);

}  // namespace launch
