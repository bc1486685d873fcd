// SPDX-License-Identifier: Apache-2.0
#include "base/text/utf8.hpp"

#include <gtest/gtest.h>

namespace launch {
namespace {

std::string repaired(std::string_view bytes) {
  std::string text;
  append_as_utf8(text, bytes);
  return text;
}

constexpr std::string_view kMark = "\xEF\xBF\xBD";

TEST(Utf8, AcceptsCharactersOfEveryLength) {
  for (const std::string_view text :
       {"", "plain text", "\x7F", "\xC2\x80", "\xDF\xBF", "\xE0\xA0\x80", "\xED\x9F\xBF", "\xEE\x80\x80",
        "\xEF\xBF\xBF", "\xF0\x90\x80\x80", "\xF4\x8F\xBF\xBF", "12345678\xC3\xA4 12345678 \xE2\x82\xAC"}) {
    EXPECT_TRUE(is_utf8(text)) << text;
    EXPECT_EQ(repaired(text), text);
  }
  EXPECT_TRUE(is_utf8(std::string_view("a\0b", 3)));
}

TEST(Utf8, ReplacesEachMaximalInvalidPart) {
  const std::string mark(kMark);
  EXPECT_EQ(repaired("a\xFF"
                     "b"),
            "a" + mark + "b");
  EXPECT_EQ(repaired("\x80\x80"), mark + mark);
  EXPECT_EQ(repaired("\xC0\xAF"), mark + mark) << "overlong";
  EXPECT_EQ(repaired("\xE0\x80\x80"), mark + mark + mark) << "overlong";
  EXPECT_EQ(repaired("\xED\xA0\x80"), mark + mark + mark) << "a surrogate";
  EXPECT_EQ(repaired("\xF4\x90\x80\x80"), mark + mark + mark + mark) << "beyond U+10FFFF";
  EXPECT_EQ(repaired("\xE2\x82"), mark) << "one mark for one cut-off character";
  EXPECT_EQ(repaired("\xE2\x82x"), mark + "x");
  EXPECT_EQ(repaired("\xF0\x90\x80\xC3\xA4"), mark + "\xC3\xA4");
}

TEST(Utf8, KnowsHowMuchOfACharacterIsMissing) {
  EXPECT_EQ(incomplete_utf8_suffix("abc"), 0U);
  EXPECT_EQ(incomplete_utf8_suffix("\xE2\x82\xAC"), 0U);
  EXPECT_EQ(incomplete_utf8_suffix("a\xE2"), 1U);
  EXPECT_EQ(incomplete_utf8_suffix("a\xE2\x82"), 2U);
  EXPECT_EQ(incomplete_utf8_suffix("a\xF0\x90\x80"), 3U);
  EXPECT_EQ(incomplete_utf8_suffix("a\x82\x82"), 0U);
  EXPECT_EQ(incomplete_utf8_suffix(""), 0U);
}

TEST(Utf8, RefusesWhatIsNoCharacter) {
  for (const char* text :
       {"\x80", "\xC0\x80", "\xE0\x80\x80", "\xED\xA0\x80", "\xF4\x90\x80\x80", "\xC3", "\xE2\x82x"}) {
    EXPECT_FALSE(decode_utf8(text).valid);
    EXPECT_EQ(decode_utf8(text).size, 1U);
  }
}

TEST(Utf8, ReadsBackWhatItWrote) {
  for (const char32_t character : {U'a', U'\u00E4', U'\u20AC', U'\U0001F600', U'\uFFFF'}) {
    std::string text;
    append_utf8(text, character);
    EXPECT_TRUE(decode_utf8(text).valid);
    EXPECT_EQ(decode_utf8(text).value, character);
    EXPECT_EQ(decode_utf8(text).size, text.size());
  }
}

}  // namespace
}  // namespace launch
