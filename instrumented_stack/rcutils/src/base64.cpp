// SPDX-License-Identifier: Apache-2.0
#include "rcutils/base64.h"

#include <string.h>

#include <string_view>

#include "rcutils/error_handling.h"
#include "rcutils/strnlen.h"

namespace {

constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
constexpr size_t kBytes = 3;    // of a group
constexpr size_t kLetters = 4;  // of its text
constexpr unsigned kBitsOfLetter = 6;

rcutils_ret_t fail(rcutils_ret_t code, const char* message) {
  RCUTILS_SET_ERROR_MSG(message);
  return code;
}

// How many '=' end the text: no more than two.
size_t padding_of(std::string_view text) {
  const size_t last = text.find_last_not_of('=');
  return text.size() - (last == std::string_view::npos ? 0 : last + 1);
}

}  // namespace

size_t rcutils_strnlen(const char* s, size_t maxlen) {
  return s == nullptr ? 0 : ::strnlen(s, maxlen);
}

rcutils_ret_t rcutils_decode_base64(const char* base64_str, rcutils_uint8_array_t* byte_array,
                                    const rcutils_allocator_t* allocator) {
  if (base64_str == nullptr || byte_array == nullptr || !rcutils_allocator_is_valid(allocator)) {
    return fail(RCUTILS_RET_INVALID_ARGUMENT, "a text, an array and an allocator are needed to decode base64");
  }
  if (byte_array->buffer != nullptr || byte_array->buffer_length != 0 || byte_array->buffer_capacity != 0) {
    return fail(RCUTILS_RET_INVALID_ARGUMENT, "the array for decoded bytes must be zero-initialized");
  }
  const std::string_view text(base64_str, rcutils_strnlen(base64_str, RCUTILS_BASE64_ENCODED_MAX_LENGTH));
  if (text.size() == RCUTILS_BASE64_ENCODED_MAX_LENGTH) {
    return fail(RCUTILS_RET_ERROR, "the text of base64 is too long");
  }
  if (text.empty()) {
    return RCUTILS_RET_OK;
  }
  const size_t padding = padding_of(text);
  if (text.size() % kLetters != 0 || padding > 2) {
    return fail(RCUTILS_RET_ERROR,
                "a text of base64 has groups of four characters, the last of which may end with '=' or '=='");
  }
  if (text.find_first_not_of(kDigits) < text.size() - padding) {
    return fail(RCUTILS_RET_ERROR, "a text of base64 has a character that is none of it");
  }
  const size_t count = text.size() / kLetters * kBytes - padding;
  const rcutils_ret_t made = rcutils_uint8_array_init(byte_array, count, allocator);
  if (made != RCUTILS_RET_OK) {
    return made;
  }
  unsigned bits = 0;
  unsigned pending = 0;  // bits that no byte has yet
  for (const char letter : text.substr(0, text.size() - padding)) {
    bits = (bits << kBitsOfLetter | static_cast<unsigned>(kDigits.find(letter))) & 0xffffU;
    pending += kBitsOfLetter;
    if (pending >= 8) {
      pending -= 8;
      byte_array->buffer[byte_array->buffer_length++] = static_cast<uint8_t>(bits >> pending);
    }
  }
  return RCUTILS_RET_OK;
}

rcutils_ret_t rcutils_encode_base64(const rcutils_uint8_array_t* byte_array, char** base64_str,
                                    const rcutils_allocator_t* allocator) {
  if (byte_array == nullptr || byte_array->buffer == nullptr || byte_array->buffer_length == 0 ||
      base64_str == nullptr || !rcutils_allocator_is_valid(allocator)) {
    return fail(RCUTILS_RET_INVALID_ARGUMENT,
                "bytes, a place for the text and an allocator are needed to encode base64");
  }
  const size_t groups = (byte_array->buffer_length + kBytes - 1) / kBytes;
  if (groups >= RCUTILS_BASE64_ENCODED_MAX_LENGTH / kLetters) {
    return fail(RCUTILS_RET_ERROR, "there are too many bytes for a text of base64");
  }
  auto* const text = static_cast<char*>(allocator->allocate(groups * kLetters + 1, allocator->state));
  if (text == nullptr) {
    return fail(RCUTILS_RET_BAD_ALLOC, "no memory for a text of base64");
  }
  char* end = text;
  for (size_t first = 0; first < byte_array->buffer_length; first += kBytes) {
    unsigned bits = 0;
    for (size_t i = 0; i < kBytes; ++i) {
      const size_t at = first + i;
      bits = bits << 8 | (at < byte_array->buffer_length ? byte_array->buffer[at] : 0U);
    }
    const size_t bytes = byte_array->buffer_length - first;  // one byte is two letters, two are three
    for (size_t i = 0; i < kLetters; ++i) {
      *end++ = i <= bytes ? kDigits[bits >> (kBitsOfLetter * (kLetters - 1 - i)) & 0x3fU] : '=';
    }
  }
  *end = '\0';
  *base64_str = text;
  return RCUTILS_RET_OK;
}
