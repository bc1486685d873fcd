// SPDX-License-Identifier: Apache-2.0
// Bytes as text, as RFC 4648 has it, with padding.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace launch {

std::string to_base64(std::string_view bytes);

// Nothing for a text that is no Base64.
std::optional<std::string> from_base64(std::string_view text);

}  // namespace launch
