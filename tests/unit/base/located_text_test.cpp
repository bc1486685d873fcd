// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "base/diagnostics/source.hpp"

namespace launch {
namespace {

std::shared_ptr<const SourceFile> file_of(std::string text) {
  return std::make_shared<const SourceFile>("a.xml", std::move(text));
}

std::string raw(const SourceRange& range) {
  return range.file->text().substr(range.begin, range.end - range.begin);
}

TEST(LocatedText, VerbatimTextStandsByteForByte) {
  const auto file = file_of("name='talker'");
  const LocatedText text("talker", {file, 6, 12});
  EXPECT_EQ(raw(text.range(1, 3)), "alk");
  EXPECT_EQ(raw(text.range()), "talker");
}

TEST(LocatedText, BytesBehindADecodedEntityKeepTheirPlace) {
  const auto file = file_of("a&quot;bc");
  LocatedText text({}, {file, 0, 0});
  text.append("a", 0, 1);
  text.append("\"", 1, 7);
  text.append("bc", 7, 9);
  EXPECT_EQ(text.text(), "a\"bc");
  EXPECT_EQ(raw(text.range(1, 1)), "&quot;");
  EXPECT_EQ(raw(text.range(2, 1)), "b");
  EXPECT_EQ(raw(text.range(0, 3)), "a&quot;b");
  EXPECT_EQ(raw(text.range()), "a&quot;bc");
}

TEST(LocatedText, EmptyRangeIsAPoint) {
  const auto file = file_of("abc");
  const LocatedText text("abc", {file, 0, 3});
  EXPECT_EQ(text.range(1, 0).begin, 1U);
  EXPECT_EQ(text.range(1, 0).end, 1U);
  EXPECT_EQ(text.range(3, 0).begin, 3U) << "behind the last byte";
  EXPECT_EQ(text.range(3, 1).begin, 3U);
}

TEST(LocatedText, TextOfOtherLengthStandsAsAWhole) {
  const auto file = file_of("'it''s'");
  const LocatedText text("it's", {file, 1, 6});
  EXPECT_EQ(raw(text.range(3, 1)), "it''s");
}

TEST(LocatedText, TextFromNoFileHasNoPlace) {
  const LocatedText text("abc");
  EXPECT_FALSE(text.range());
  EXPECT_FALSE(text.range(1, 1));
}

}  // namespace
}  // namespace launch
