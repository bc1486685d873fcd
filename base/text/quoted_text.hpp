// SPDX-License-Identifier: Apache-2.0
// Texts as other languages quote them: words of a shell, text of XML.
#pragma once

#include <string>
#include <string_view>

namespace launch {

// The text with entities for the characters that mean something in XML text and in quoted attributes.
std::string as_xml_text(std::string_view text);

// A word quoted in such a way that a shell reads this word.
std::string shell_quoted(const std::string& word);

// In these quotes, with a backslash before them and before a backslash, and "\n", "\t" and "\r": Python and YAML read
// that.
std::string backslash_quoted(std::string_view text, char quote);

// With "?" for each control character: a text that stands in a line of a terminal or of a log can't forge another line.
std::string without_control_characters(std::string text);

}  // namespace launch
