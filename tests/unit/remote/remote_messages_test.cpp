// SPDX-License-Identifier: Apache-2.0
#include "programs/launch/remote/remote_messages.hpp"

#include <gmock/gmock.h>

#include <stdexcept>

namespace {

using namespace launch;

TEST(RemoteMessagesTest, ComeInAnyPieces) {
  const std::string all_bytes = [] {
    std::string text;
    for (int byte = 0; byte < 256; ++byte) {
      text += static_cast<char>(byte);
    }
    return text;
  }();
  const std::string stream =
      encode(RemoteKind::kOutput, all_bytes) + encode(RemoteKind::kError, "") + encode(RemoteKind::kExit, "3");
  for (std::size_t piece = 1; piece <= stream.size(); ++piece) {
    RemoteMessages messages;
    std::vector<RemoteMessage> got;
    for (std::size_t begin = 0; begin < stream.size(); begin += piece) {
      messages.add(std::string_view(stream).substr(begin, piece));
      while (auto message = messages.take()) {
        got.push_back(*std::move(message));
      }
    }
    ASSERT_EQ(got.size(), 3U);
    EXPECT_EQ(got[0].content, all_bytes);
    EXPECT_EQ(got[1].kind, RemoteKind::kError);
    EXPECT_EQ(got[2].content, "3");
  }
}

TEST(RemoteMessagesTest, WhatIsNoMessageIsAnError) {
  RemoteMessages messages;
  messages.add("Last login: Sat Nov 28");
  EXPECT_THROW(messages.take(), std::runtime_error);
}

TEST(RemoteMessagesTest, GreetingIsALineOfItsOwn) {
  const std::string line = greeting_line("0.1.0");
  EXPECT_EQ(line, "launch-remote 1 0.1.0\n");
  const auto greeting = parse_greeting("launch-remote 1 0.1.0\r");
  ASSERT_TRUE(greeting);
  EXPECT_EQ(greeting->version, 1);
  EXPECT_EQ(greeting->launch_version, "0.1.0");
  for (const char* const other : {"", "Welcome", "launch-remote", "launch-remote 1", "launch-remote x 0.1.0",
                                  "launch-remote 1 0.1.0 more", " launch-remote 1 0.1.0"}) {
    EXPECT_FALSE(parse_greeting(other)) << other;
  }
}

TEST(RemoteMessagesTest, ARequestArrivesAsItWas) {
  const std::vector<std::string> words = {"stop", "camera*", "it's", "a \"b\"", "$HOME `x`", "", "two\nlines"};
  const RemoteRequest request{words, {{"TERM", "xterm"}}, TerminalSize{100, 30}};
  const RemoteRequest got = parse_remote_request(to_text(request));
  EXPECT_EQ(got.words, words);
  EXPECT_EQ(got.environment, request.environment);
  ASSERT_TRUE(got.terminal);
  EXPECT_EQ(got.terminal->columns, 100U);
  EXPECT_EQ(got.terminal->lines, 30U);
  EXPECT_FALSE(parse_remote_request(to_text(RemoteRequest{{"ps"}, {}, std::nullopt})).terminal);
  EXPECT_THROW(parse_remote_request("{}"), std::runtime_error);
  EXPECT_THROW(parse_remote_request("x"), std::runtime_error);
}

TEST(RemoteMessagesTest, ASizeThatIsNoneIsThatOfAnOldTerminal) {
  for (const char* const text : {"", "0 0", "-1 80", "99999 80", "x"}) {
    EXPECT_EQ(parse_size(text).lines, 24U) << text;
    EXPECT_EQ(parse_size(text).columns, 80U) << text;
  }
}

}  // namespace
