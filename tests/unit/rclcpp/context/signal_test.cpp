// SPDX-License-Identifier: Apache-2.0
// Signals reach a thread that waits in the system, and the handlers that a program had before.
#include <gtest/gtest.h>
#include <pthread.h>
#include <signal.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <thread>

#include "tests/unit/rclcpp/ros_test.hpp"

namespace {

class Signals : public RosTest {};

TEST_F(Signals, EndAReadThatBlocks) {
  int ends[2];
  ASSERT_EQ(pipe(ends), 0);
  std::atomic<bool> ended{false};
  // The first signals may come before the read begins. A read that goes on after each gets a byte at last.
  std::thread sender([&, reader = pthread_self()] {
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(60);
    while (!ended && std::chrono::steady_clock::now() < deadline) {
      pthread_kill(reader, SIGINT);
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    if (!ended) {
      EXPECT_EQ(write(ends[1], "x", 1), 1);
    }
  });
  char byte = 0;
  const ssize_t count = read(ends[0], &byte, 1);
  const int error = errno;
  ended = true;
  sender.join();
  EXPECT_EQ(count, -1);
  EXPECT_EQ(error, EINTR);
  close(ends[0]);
  close(ends[1]);
}

std::atomic<int> g_plain{0};
std::atomic<int> g_with_info{0};

// A signal that comes just before the shutdown ends the contexts of then, not those of the next init().
TEST_F(Signals, EndNoLaterContext) {
  for (int i = 0; i < 20; ++i) {
    raise(SIGINT);
    rclcpp::shutdown();
    rclcpp::init(0, nullptr);
    rclcpp::uninstall_signal_handlers();  // waits for the thread that would end the context
    ASSERT_TRUE(rclcpp::ok()) << i;
    rclcpp::install_signal_handlers();
  }
}

TEST_F(Signals, CallTheEarlierHandlersOfBothKinds) {
  rclcpp::shutdown();
  struct sigaction plain {};
  plain.sa_handler = [](int number) { g_plain = number; };
  struct sigaction with_info {};
  with_info.sa_flags = SA_SIGINFO;
  with_info.sa_sigaction = [](int, siginfo_t* info, void*) { g_with_info = info->si_signo; };
  struct sigaction previous_sigint {};
  struct sigaction previous_sigterm {};
  sigaction(SIGINT, &plain, &previous_sigint);
  sigaction(SIGTERM, &with_info, &previous_sigterm);
  rclcpp::init(0, nullptr);
  raise(SIGINT);
  raise(SIGTERM);
  EXPECT_EQ(g_plain, SIGINT);
  EXPECT_EQ(g_with_info, SIGTERM);
  rclcpp::shutdown();
  sigaction(SIGINT, &previous_sigint, nullptr);
  sigaction(SIGTERM, &previous_sigterm, nullptr);
}

}  // namespace
