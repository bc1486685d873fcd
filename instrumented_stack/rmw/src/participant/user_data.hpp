// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace rmw_fastrtps {

// The value of `<key>=…;` in the user data that participants and endpoints announce; empty if the key is missing.
// Others may announce any bytes.
std::string user_data_value(std::string_view user_data, std::string_view key);

}  // namespace rmw_fastrtps
