// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <rcutils/base64.h>
#include <rcutils/error_handling.h>
#include <rcutils/strnlen.h>
#include <stdlib.h>

#include <string>
#include <utility>
#include <vector>

namespace {

const rcutils_allocator_t kTextAllocator = rcutils_get_default_allocator();

// "!" and the code if it fails.
std::string decoded(const char* text) {
  rcutils_uint8_array_t array = rcutils_get_zero_initialized_uint8_array();
  const rcutils_ret_t result = rcutils_decode_base64(text, &array, &kTextAllocator);
  rcutils_reset_error();
  std::string bytes = result == RCUTILS_RET_OK ? std::string(array.buffer, array.buffer + array.buffer_length)
                                               : "!" + std::to_string(result);
  if (array.buffer != nullptr) {
    EXPECT_EQ(rcutils_uint8_array_fini(&array), RCUTILS_RET_OK);
  }
  return bytes;
}

std::string encoded(std::string bytes) {
  rcutils_uint8_array_t array = rcutils_get_zero_initialized_uint8_array();
  array.buffer = reinterpret_cast<std::uint8_t*>(bytes.data());
  array.buffer_length = bytes.size();
  char* text = nullptr;
  EXPECT_EQ(rcutils_encode_base64(&array, &text, &kTextAllocator), RCUTILS_RET_OK);
  std::string result = text;
  free(text);
  return result;
}

// The examples of RFC 4648.
TEST(Base64, IsWrittenAndRead) {
  for (const auto& [bytes, text] : std::vector<std::pair<std::string, std::string>>{{"f", "Zg=="},
                                                                                    {"fo", "Zm8="},
                                                                                    {"foo", "Zm9v"},
                                                                                    {"foob", "Zm9vYg=="},
                                                                                    {"fooba", "Zm9vYmE="},
                                                                                    {"foobar", "Zm9vYmFy"},
                                                                                    {{'\xfb', '\xff', '\0'}, "+/8A"}}) {
    EXPECT_EQ(encoded(bytes), text);
    EXPECT_EQ(decoded(text.c_str()), bytes);
  }
  EXPECT_EQ(decoded(""), "");
}

TEST(Base64, IsRefusedWhereItIsNone) {
  const std::string error = "!" + std::to_string(RCUTILS_RET_ERROR);
  for (const char* const text : {"Zg", "Zg=", "Z===", "====", "Zg==Zg==", "Zm 9", "Zm9v\n", "Z-9v", "=Zg="}) {
    EXPECT_EQ(decoded(text), error) << text;
  }
  const std::string invalid = "!" + std::to_string(RCUTILS_RET_INVALID_ARGUMENT);
  EXPECT_EQ(decoded(nullptr), invalid);
  rcutils_uint8_array_t array = rcutils_get_zero_initialized_uint8_array();
  EXPECT_EQ(rcutils_decode_base64("Zg==", &array, nullptr), RCUTILS_RET_INVALID_ARGUMENT);
  array.buffer_length = 1;
  EXPECT_EQ(rcutils_decode_base64("Zg==", &array, &kTextAllocator), RCUTILS_RET_INVALID_ARGUMENT);
  char* text = nullptr;
  EXPECT_EQ(rcutils_encode_base64(&array, &text, &kTextAllocator), RCUTILS_RET_INVALID_ARGUMENT);
  rcutils_reset_error();
}

TEST(Strnlen, LooksNoFurtherThanItMay) {
  EXPECT_EQ(rcutils_strnlen("abc", 10), 3u);
  EXPECT_EQ(rcutils_strnlen("abc", 2), 2u);
  EXPECT_EQ(rcutils_strnlen(nullptr, 2), 0u);
}

}  // namespace
