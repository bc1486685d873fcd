// SPDX-License-Identifier: Apache-2.0
// `launch test FILE|DIRECTORY…`: runs the tests of launch files.
#pragma once

#include <string>
#include <vector>

namespace launch {

// `words` come after "launch test". Returns the exit code: 0 when every test has passed, 1 when one has failed or a
// launch file has an error, 2 for a wrong command line, 128+N after signal N.
int test_command(std::vector<std::string> words);

}  // namespace launch
