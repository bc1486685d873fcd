// SPDX-License-Identifier: Apache-2.0
// The files of the commands that write launch files anew.
#pragma once

#include <string>
#include <vector>

namespace launch {

// The words, with the XML and YAML launch files below a directory in its place, in order.
std::vector<std::string> launch_files_in(const std::vector<std::string>& words);

// Puts the text in the place of a file that is there. A link stays one, and the permissions stay. Throws LaunchError.
void rewrite_file(const std::string& path, const std::string& text);

}  // namespace launch
