// SPDX-License-Identifier: Apache-2.0
// JSON written as text. It takes a fraction of the time of a tree of values, which counts where there are thousands.
#pragma once

#include <string>
#include <string_view>

namespace launch {

// Appends the text in quotes. What is no UTF-8 is replaced.
void append_json_string(std::string& to, std::string_view text);

}  // namespace launch
