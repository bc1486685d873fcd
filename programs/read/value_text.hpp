// SPDX-License-Identifier: Apache-2.0
// Writes the values of fields as text or as JSON.
#pragma once

#include <fmt/format.h>

#include <string_view>

#include "tracing/decode/reader/event.hpp"

namespace tracing {

using Buffer = fmt::memory_buffer;

void append(Buffer& out, std::string_view text);

// A text between quotes, as in JSON. JSON can't hold bytes that are not UTF-8, so U+FFFD replaces them.
void append_quoted(Buffer& out, std::string_view text);

bool is_number(const FieldValue& value);
void append_number(Buffer& out, const FieldValue& value, bool hexadecimal);

// As text: a pointer in hexadecimal, a structure as {a=1 b=2}, an array as [1 2].
void append_text(Buffer& out, const FieldValue& value);

// As JSON: numbers in decimal, an enumeration as its label if it has one.
void append_json(Buffer& out, const FieldValue& value);

}  // namespace tracing
