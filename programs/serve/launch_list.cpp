// SPDX-License-Identifier: Apache-2.0
#include "programs/serve/launch_list.hpp"

#include <utility>

namespace launch::serve {

ControlClient::Json launch_list(const Environment& environment) {
  ControlClient::Json list = ControlClient::Json::array();
  for (FoundLaunch& found : find_launches(environment)) {
    ControlClient client(std::move(found));
    try {
      list.push_back(client.ask("info")["launch"]);
    } catch (const ControlError& error) {
      if (!client.ended()) {
        list.push_back({{"pid", client.pid()}, {"error", error.what()}});
      }
    }
  }
  return list;
}

std::optional<ControlClient> find_launch(const Environment& environment, pid_t pid) {
  for (FoundLaunch& found : find_launches(environment)) {
    if (found.pid == pid) {
      return ControlClient(std::move(found));
    }
  }
  return std::nullopt;
}

}  // namespace launch::serve
