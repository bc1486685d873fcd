// SPDX-License-Identifier: Apache-2.0
// Words of a shell.
#pragma once

#include <string>

namespace launch {

// A word quoted in such a way that a shell reads this word.
std::string shell_quoted(const std::string& word);

}  // namespace launch
