// SPDX-License-Identifier: Apache-2.0
// What there is to say of each finding of `launch check`: the one table of their ids.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "base/diagnostics/diagnostic.hpp"

namespace launch {

struct FindingInfo {
  Finding finding;
  std::string_view title;
  Severity severity;  // in an action that is visited; errors in what a condition leaves out are warnings
  std::string_view explanation;
  std::string_view example;              // a launch file that has the finding
  std::string_view parameter_file = {};  // params.yaml beside it, if the example needs one
};

// In the order of the ids.
std::span<const FindingInfo> finding_table();

// The parts of the table, each in a source of its own.
std::span<const FindingInfo> findings_of_files();
std::span<const FindingInfo> findings_of_systems();

// "LF0101"
std::string finding_id(Finding finding);
// The finding with this id, in upper or lower case.
std::optional<Finding> find_finding(std::string_view id);
// An error for an id that no finding has; without a place.
LaunchError unknown_finding(const std::string& id);
const FindingInfo& finding_info(Finding finding);

}  // namespace launch
