// SPDX-License-Identifier: Apache-2.0
// Explains the errors of YAML that can't be parsed, in terms of launch files.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "base/diagnostics/diagnostic.hpp"

namespace launch {

// `rule` is the message of yaml-cpp (YAML::ErrorMsg). `at` is its place, a byte of `source`. `open_bracket` is the
// place of the innermost '[' or '{' that is still open at `at`.
Diagnostic explain_yaml_error(const std::string& rule, std::size_t at, const LocatedText& source,
                              const std::optional<std::size_t>& open_bracket);

}  // namespace launch
