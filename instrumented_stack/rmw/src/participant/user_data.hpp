// SPDX-License-Identifier: Apache-2.0
// What participants and endpoints announce about themselves: entries of the form `<key>=…;`.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace rmw_fastrtps {

using UserData = std::vector<std::uint8_t>;

// Of a participant. Includes the terminating null, as rmw_fastrtps_cpp sends it.
UserData enclave_user_data(const std::string& enclave);

// Of an endpoint, so that others can see whether they use the same definition of the type. Empty without a hash, when
// only the name of the type is known.
UserData type_hash_user_data(const std::string& type_hash);

// The value of a key; empty if the key is missing. Others may announce any bytes.
std::string user_data_value(std::string_view user_data, std::string_view key);
std::string user_data_value(const UserData& user_data, std::string_view key);

}  // namespace rmw_fastrtps
