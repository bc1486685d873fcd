// SPDX-License-Identifier: Apache-2.0
#include "launcher/traced/snapshot_socket.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <unistd.h>

#include <future>
#include <string>

namespace {

using namespace launch;

class SnapshotSocket : public testing::Test {
 protected:
  // Waits for somebody who asks.
  UniqueFd asker() {
    pollfd readable{listener.get(), POLLIN, 0};
    EXPECT_EQ(::poll(&readable, 1, -1), 1);
    return take_snapshot_request(listener);
  }

  // Other tests may run beside this one.
  const std::string session = fmt::format("session-{}-{}", ::getpid(), std::string(200, 'x'));
  UniqueFd listener = listen_for_snapshots(session);
};

TEST_F(SnapshotSocket, TheAnswerComesWhenItIsThere) {
  ASSERT_TRUE(listener);
  for (const bool complete : {true, false}) {
    auto asked = std::async(std::launch::async, [this] { return ask_for_snapshot(session); });
    send_snapshot_answer(asker(), {.directory = "/traces/walk/snapshot-1", .complete = complete});
    const auto answer = asked.get();
    ASSERT_TRUE(answer);
    EXPECT_EQ(answer->directory, "/traces/walk/snapshot-1");
    EXPECT_EQ(answer->complete, complete);
    EXPECT_EQ(answer->error, "");
  }
}

TEST_F(SnapshotSocket, AnErrorIsAnAnswer) {
  auto asked = std::async(std::launch::async, [this] { return ask_for_snapshot(session); });
  send_snapshot_answer(asker(), {.error = "the trace is ending"});
  EXPECT_EQ(asked.get()->error, "the trace is ending");
}

TEST_F(SnapshotSocket, ALaunchThatEndsMeanwhileIsAnError) {
  auto asked = std::async(std::launch::async, [this] { return ask_for_snapshot(session); });
  asker() = UniqueFd();
  EXPECT_EQ(asked.get()->error, "the launch has ended before the snapshot was there");
}

TEST_F(SnapshotSocket, OnlyOneLaunchHasASession) {
  EXPECT_FALSE(listen_for_snapshots(session));
  EXPECT_FALSE(ask_for_snapshot(session + "-another"));
  listener = UniqueFd();
  EXPECT_FALSE(ask_for_snapshot(session));
  EXPECT_TRUE(listen_for_snapshots(session));
}

TEST_F(SnapshotSocket, NobodyHasAsked) {
  EXPECT_FALSE(take_snapshot_request(listener));
}

}  // namespace
