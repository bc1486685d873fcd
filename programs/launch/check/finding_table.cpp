// SPDX-License-Identifier: Apache-2.0
// The rows are in findings_of_files.cpp and findings_of_systems.cpp.
#include "programs/launch/check/finding_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <vector>

namespace launch {

std::span<const FindingInfo> finding_table() {
  static const std::vector<FindingInfo> all = [] {
    std::vector<FindingInfo> rows;
    for (const std::span<const FindingInfo> some : {findings_of_files(), findings_of_systems()}) {
      rows.insert(rows.end(), some.begin(), some.end());
    }
    return rows;
  }();
  return all;
}

std::string finding_id(Finding finding) {
  return fmt::format("LF{:04}", static_cast<int>(finding));
}

std::optional<Finding> find_finding(std::string_view id) {
  const auto same = [&](const FindingInfo& info) {
    const std::string own = finding_id(info.finding);
    return std::equal(own.begin(), own.end(), id.begin(), id.end(),
                      [](char a, char b) { return a == (b >= 'a' && b <= 'z' ? b - 'a' + 'A' : b); });
  };
  const std::span<const FindingInfo> table = finding_table();
  const auto found = std::find_if(table.begin(), table.end(), same);
  return found == table.end() ? std::nullopt : std::optional(found->finding);
}

LaunchError unknown_finding(const std::string& id) {
  std::vector<std::string> ids;
  for (const FindingInfo& info : finding_table()) {
    ids.push_back(finding_id(info.finding));
  }
  std::string help = did_you_mean(id, ids);
  return {fmt::format("no finding has the id '{}'", id),
          {},
          help.empty() ? "`launch explain` lists all findings" : std::move(help)};
}

const FindingInfo& finding_info(Finding finding) {
  const std::span<const FindingInfo> table = finding_table();
  const auto found =
      std::find_if(table.begin(), table.end(), [&](const FindingInfo& info) { return info.finding == finding; });
  if (found == table.end()) {
    throw std::logic_error(fmt::format("finding {} has no row in the table", static_cast<int>(finding)));
  }
  return *found;
}

}  // namespace launch
