// SPDX-License-Identifier: Apache-2.0
#include "participant/user_data.hpp"

namespace rmw_fastrtps {

UserData enclave_user_data(const std::string& enclave) {
  const std::string text = "enclave=" + enclave + ";";
  return {text.c_str(), text.c_str() + text.size() + 1};
}

UserData type_hash_user_data(const std::string& type_hash) {
  const std::string text = type_hash.empty() ? "" : "typehash=" + type_hash + ";";
  return {text.begin(), text.end()};
}

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

std::string user_data_value(const UserData& user_data, std::string_view key) {
  return user_data_value(std::string_view(reinterpret_cast<const char*>(user_data.data()), user_data.size()), key);
}

}  // namespace rmw_fastrtps
