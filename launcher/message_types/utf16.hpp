// SPDX-License-Identifier: Apache-2.0
// Converts the text of `wstring` fields, which messages carry as UTF-16.
#pragma once

#include <string>
#include <string_view>

namespace launch {

// What is no UTF-8, or no pair of surrogates, becomes U+FFFD.
std::u16string to_utf16(std::string_view utf8);
std::string to_utf8(std::u16string_view utf16);

}  // namespace launch
