// SPDX-License-Identifier: Apache-2.0
// The check of a text that both file formats need before they parse it.
#pragma once

#include <optional>

#include "base/diagnostics/diagnostic.hpp"
#include "base/diagnostics/source.hpp"

namespace launch {

inline constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

// An error for the first character that neither XML nor YAML allows: a control character, bytes that are not UTF-8, or
// the byte order mark of UTF-16. Nullopt if there is none.
std::optional<Diagnostic> find_bad_character(const LocatedText& text);

}  // namespace launch
