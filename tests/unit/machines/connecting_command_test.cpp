// SPDX-License-Identifier: Apache-2.0
#include "launcher/machines/connecting_command.hpp"

#include <gtest/gtest.h>
#include <poll.h>
#include <signal.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <string>

#include "tests/support/sandbox.hpp"

namespace {

using launch::ConnectingCommand;

// Otherwise the launch would wait for it, with all other machines, before it kills it.
TEST(ConnectingCommandTest, EndsGentlyAlsoWhenItIsStopped) {
  const test_support::Sandbox sandbox;
  const std::string ended = sandbox.directory() / "ended";
  ConnectingCommand command(
      {"/bin/sh", "-c", "trap 'echo > \"$0\"; exit' TERM; echo $$; while :; do read x || :; done", ended});
  pollfd readable{command.output(), POLLIN, 0};
  ASSERT_EQ(::poll(&readable, 1, -1), 1);
  std::array<char, 32> number{};
  ASSERT_GT(::read(command.output(), number.data(), number.size() - 1), 0);
  ::kill(std::atoi(number.data()), SIGSTOP);
  EXPECT_EQ(command.end(std::chrono::milliseconds(0)), "did not end by itself");
  EXPECT_TRUE(std::filesystem::exists(ended));
}

}  // namespace
