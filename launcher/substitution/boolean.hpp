// SPDX-License-Identifier: Apache-2.0
// The two ways in which launch files read a text as a boolean, and when two texts are equal.
#pragma once

#include <optional>
#include <string_view>

namespace launch {

// For `if` and `unless`: true/1 and false/0 after trimming, in any case. Nothing else is a boolean there.
std::optional<bool> condition_boolean(std::string_view text);

// For `not and or if`, `respawn` and boolean attributes: 1 and 0, and the YAML 1.1 words in their three spellings.
std::optional<bool> yaml_boolean(std::string_view text);

// For `equals`. Compares as booleans when both texts are true/false/1/0, as numbers (relative closeness 1e-9) when both
// are numbers, else as text.
bool launch_equal(std::string_view left, std::string_view right);

}  // namespace launch
