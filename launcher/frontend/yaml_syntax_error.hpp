// SPDX-License-Identifier: Apache-2.0
// Says in the words of a launch file what is wrong with YAML that can't be parsed.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "launcher/base/diagnostic.hpp"

namespace launch {

// `rule` is what yaml-cpp says (YAML::ErrorMsg), `at` the byte of `source` where it says so, `open_bracket` the place
// of the innermost '[' or '{' that is still open there.
Diagnostic explain_yaml_error(const std::string& rule, std::size_t at, const LocatedText& source,
                              const std::optional<std::size_t>& open_bracket);

}  // namespace launch
