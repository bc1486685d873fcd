// SPDX-License-Identifier: Apache-2.0
// What both file formats demand of a text before it is parsed.
#pragma once

#include <optional>

#include "launcher/base/diagnostic.hpp"
#include "launcher/base/source.hpp"

namespace launch {

inline constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

// The first character that neither XML nor YAML allows (a control character, bytes that are not UTF-8, a file in
// UTF-16), as an error; nullopt when there is none.
std::optional<Diagnostic> find_bad_character(const LocatedText& text);

}  // namespace launch
