// SPDX-License-Identifier: Apache-2.0
#include "launcher/control/control_groups_text.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "launcher/process/control_groups/control_group_use.hpp"

namespace launch {

std::string control_groups_text(const std::string& path) {
  using GroupJson = nlohmann::ordered_json;
  GroupJson groups = GroupJson::array();
  double share = -1;
  for (const ControlGroupUse& use : read_control_groups(path)) {
    GroupJson group = {{"name", use.name}};
    const auto put = [&](const char* name, const auto& value) {
      if (value) {
        group[name] = *value;
      }
    };
    put("memory", use.memory);
    put("memory_max", use.memory_max);
    put("memory_high", use.memory_high);
    put("pids", use.pids);
    put("pids_max", use.pids_max);
    put("cpu_quota", use.cpu_quota);
    if (use.throttled) {
      group["throttled"] = static_cast<double>(*use.throttled) * 1e-6;
    }
    group["out_of_memory"] = use.out_of_memory;
    groups.push_back(std::move(group));
    if (use.memory && use.memory_max && *use.memory_max > 0) {
      share = std::max(share, static_cast<double>(*use.memory) / static_cast<double>(*use.memory_max));
    }
  }
  std::string text = ",\"control_groups\":" + groups.dump();
  return share < 0 ? text : text + ",\"memory_share\":" + GroupJson(share).dump();
}

}  // namespace launch
