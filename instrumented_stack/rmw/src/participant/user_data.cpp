// SPDX-License-Identifier: Apache-2.0
#include "participant/user_data.hpp"

namespace rmw_fastrtps {

std::string user_data_value(std::string_view user_data, std::string_view key) {
  while (!user_data.empty()) {
    const std::string_view entry = user_data.substr(0, user_data.find(';'));
    if (entry.substr(0, entry.find('=')) == key && entry.size() > key.size()) {
      return std::string(entry.substr(key.size() + 1));
    }
    user_data.remove_prefix(entry.size());
    user_data.remove_prefix(user_data.empty() ? 0 : 1);
  }
  return {};
}

}  // namespace rmw_fastrtps
