// SPDX-License-Identifier: Apache-2.0
#include "programs/serve/open_connections.hpp"

#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>

namespace {

using launch::serve::OpenConnections;
using Doing = OpenConnections::Doing;

class OpenConnectionsTest : public testing::Test {
 protected:
  OpenConnectionsTest() { EXPECT_EQ(::socketpair(AF_UNIX, SOCK_STREAM, 0, ends_.data()), 0); }
  ~OpenConnectionsTest() override {
    for (const int end : ends_) {
      ::close(end);
    }
  }
  OpenConnectionsTest(const OpenConnectionsTest&) = delete;
  OpenConnectionsTest& operator=(const OpenConnectionsTest&) = delete;

  // The other end sees the end of the connection.
  bool is_cut() const {
    char byte = 0;
    return ::recv(ends_[1], &byte, 1, MSG_DONTWAIT) == 0;
  }

  std::array<int, 2> ends_{};
  OpenConnections connections_;
  OpenConnections::Time now_{};
};

TEST_F(OpenConnectionsTest, ARequestThatTakesTooLongIsCut) {
  connections_.add(this, ends_[0], now_);
  EXPECT_EQ(connections_.cut_late(now_ + OpenConnections::kForRequest - std::chrono::seconds(1)), 0U);
  EXPECT_FALSE(is_cut());
  EXPECT_EQ(connections_.cut_late(now_ + OpenConnections::kForRequest), 1U);
  EXPECT_TRUE(is_cut());
}

TEST_F(OpenConnectionsTest, AnAnswerHasLonger) {
  connections_.add(this, ends_[0], now_);
  connections_.set(this, Doing::kAnswer, now_);
  EXPECT_EQ(connections_.cut_late(now_ + OpenConnections::kForRequest), 0U);
  EXPECT_EQ(connections_.cut_late(now_ + OpenConnections::kForAnswer), 1U);
}

TEST_F(OpenConnectionsTest, AFeedIsNeverLateAndTheNextRequestBeginsAnew) {
  connections_.add(this, ends_[0], now_);
  connections_.set(this, Doing::kFeed, now_);
  now_ += std::chrono::hours(100);
  EXPECT_EQ(connections_.cut_late(now_), 0U);
  connections_.set(this, Doing::kRequest, now_);
  EXPECT_EQ(connections_.cut_late(now_ + std::chrono::seconds(1)), 0U);
  EXPECT_EQ(connections_.cut_late(now_ + OpenConnections::kForRequest), 1U);
}

TEST_F(OpenConnectionsTest, WhatHasGoneIsForgotten) {
  connections_.add(this, ends_[0], now_);
  connections_.remove(this);
  EXPECT_EQ(connections_.cut_late(now_ + std::chrono::hours(1)), 0U);
  EXPECT_FALSE(is_cut());
}

}  // namespace
