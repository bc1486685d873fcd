// SPDX-License-Identifier: Apache-2.0
#include "programs/launch/lsp/message_stream.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

namespace launch::lsp {
namespace {

TEST(LspMessages, ComeInPieces) {
  const std::string both = framed({{"id", 1}}) + framed({{"id", 2}});
  MessageReader reader;
  std::vector<Json> got;
  for (const char byte : both) {
    reader.add({&byte, 1});
    while (auto message = reader.next()) {
      got.push_back(*message);
    }
  }
  ASSERT_EQ(got.size(), 2U);
  EXPECT_EQ(got[0]["id"], 1);
  EXPECT_EQ(got[1]["id"], 2);
}

TEST(LspMessages, OtherHeadsArePassedOver) {
  MessageReader reader;
  reader.add("Content-Type: application/vscode-jsonrpc; charset=utf-8\r\ncontent-length:  2\r\n\r\n{}");
  EXPECT_EQ(reader.next(), Json::object());
}

TEST(LspMessages, WhatIsNotJsonIsNull) {
  MessageReader reader;
  reader.add("Content-Length: 3\r\n\r\n{x}");
  EXPECT_TRUE(reader.next()->is_null());
}

TEST(LspMessages, WhatIsNoFrameEndsTheReading) {
  for (const std::string& wrong : {std::string("Length: 3\r\n\r\n"), std::string("Content-Length: 3x\r\n\r\n"),
                                   std::string("Content-Length: 99999999999\r\n\r\n"), std::string(5000, 'x')}) {
    MessageReader reader;
    reader.add(wrong);
    EXPECT_THROW(reader.next(), std::runtime_error) << wrong.substr(0, 40);
  }
}

}  // namespace
}  // namespace launch::lsp
