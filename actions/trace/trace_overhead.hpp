// SPDX-License-Identifier: Apache-2.0
// The attributes max-overhead and drop-order of <trace>.
#pragma once

#include <string>
#include <vector>

#include "launcher/language/fields.hpp"

namespace launch {

// Reads "2%" as 0.02. Throws LaunchError.
double perform_percentage(const Template& text, Scope& scope);

// Throws LaunchError for an entry that is neither a class of events nor a pattern with its provider.
void check_drop_order(const std::vector<std::string>& order, const SourceRange& where);

}  // namespace launch
