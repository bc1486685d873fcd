// SPDX-License-Identifier: Apache-2.0
#include "programs/launch/lsp/document.hpp"

#include <gtest/gtest.h>

namespace launch::lsp {
namespace {

Json place(int line, int character) {
  return {{"line", line}, {"character", character}};
}

TEST(LspDocument, CountsColumnsInUtf16) {
  const Document document("a\n\xC3\xA9\xF0\x9F\x98\x80x\r\n");  // e with acute: one unit, a smiley: two
  EXPECT_EQ(document.position(0), place(0, 0));
  EXPECT_EQ(document.position(4), place(1, 1));
  EXPECT_EQ(document.position(8), place(1, 3));
  EXPECT_EQ(document.offset(place(1, 3)), 8U);
  EXPECT_EQ(document.offset(place(1, 1)), 4U);
}

TEST(LspDocument, MovesPlacesInside) {
  const Document document("ab\r\ncd");
  EXPECT_EQ(document.offset(place(0, 99)), 2U);
  EXPECT_EQ(document.offset(place(9, 0)), 6U);
  EXPECT_EQ(document.position(99), place(1, 2));
}

TEST(LspDocument, EndsLinesWithEachKindOfEnd) {
  const Document document("a\rb\r\nc\nd");
  EXPECT_EQ(document.position(2), place(1, 0));
  EXPECT_EQ(document.position(5), place(2, 0));
  EXPECT_EQ(document.position(7), place(3, 0));
  EXPECT_EQ(document.offset(place(0, 9)), 1U);
  EXPECT_EQ(document.offset(place(1, 9)), 3U);
}

TEST(LspDocument, KnowsColumnsInCharacters) {
  const Document document("a\n\xF0\x9F\x98\x80x\r\n");
  EXPECT_EQ(document.offset_of_character(1, 1), 6U);
  EXPECT_EQ(document.offset_of_character(1, 9), 7U);
  EXPECT_EQ(document.offset_of_character(9, 0), 9U);
}

TEST(LspDocument, TakesChangesOfRangesAndOfAll) {
  Document document("<launch>\n</launch>\n");
  document.change({{"range", {{"start", place(0, 8)}, {"end", place(1, 0)}}}, {"text", "\n <a/>\n"}});
  EXPECT_EQ(document.text(), "<launch>\n <a/>\n</launch>\n");
  EXPECT_EQ(document.position(16), place(2, 1));
  document.change({{"text", "x"}});
  EXPECT_EQ(document.text(), "x");
  EXPECT_THROW(document.change(Json::object()), Json::exception);
}

TEST(LspDocument, NamesOfFilesAreUris) {
  EXPECT_EQ(path_of("file:///a%20b/%C3%A9.xml"), "/a b/\xC3\xA9.xml");
  EXPECT_EQ(path_of("file://host/a%2"), "/a%2");
  EXPECT_EQ(path_of("untitled:1"), "");
  EXPECT_EQ(uri_of("/a b/\xC3\xA9.xml"), "file:///a%20b/%C3%A9.xml");
}

}  // namespace
}  // namespace launch::lsp
