// SPDX-License-Identifier: Apache-2.0
// The schema of `launch --dry-run=json`: docs/schema/dry_run.schema.json, which the build puts into the launcher.
#pragma once

#include <string_view>

namespace launch {

// Of the JSON. It becomes another number when a key changes its meaning or goes.
constexpr int kDryRunVersion = 1;

std::string_view dry_run_schema();

}  // namespace launch
