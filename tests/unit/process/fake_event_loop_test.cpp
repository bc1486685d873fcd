// SPDX-License-Identifier: Apache-2.0
#include "launcher/process/fake/fake_event_loop.hpp"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/eventfd.h>

#include <stdexcept>
#include <string>
#include <vector>

#include "base/files/unique_fd.hpp"

namespace launch {
namespace {

using namespace std::chrono_literals;

TEST(FakeEventLoop, LetsTimePassFromTimerToTimer) {
  FakeEventLoop loop;
  std::vector<Duration> fired;
  EventLoop::SourcePtr again;
  const auto late = loop.after(3s, [&] { fired.push_back(loop.now()); });
  const auto early = loop.after(1s, [&] {
    fired.push_back(loop.now());
    again = loop.after(1s, [&] { fired.push_back(loop.now()); });
  });
  loop.advance(999ms);
  EXPECT_TRUE(fired.empty());
  loop.advance(5s);
  EXPECT_EQ(fired, (std::vector<Duration>{1s, 2s, 3s}));
  EXPECT_EQ(loop.now(), 5999ms);
}

TEST(FakeEventLoop, RunsSignalsThenOutputThenExitsThenTimersThenPosts) {
  FakeEventLoop loop;
  const UniqueFd fd(::eventfd(1, EFD_CLOEXEC | EFD_NONBLOCK));
  std::vector<std::string> order;
  loop.post([&] { order.emplace_back("post"); });
  const auto timer = loop.after(0s, [&] { order.emplace_back("timer"); });
  const auto exit = loop.on_exit(fd.get(), [&] { order.emplace_back("exit"); });
  const UniqueFd output(::eventfd(1, EFD_CLOEXEC | EFD_NONBLOCK));
  const auto readable = loop.on_readable(output.get(), [&] {
    eventfd_t count = 0;
    ::eventfd_read(output.get(), &count);
    order.emplace_back("output");
  });
  const auto signal = loop.on_signal({SIGINT}, [&](EventLoop::Signal) { order.emplace_back("signal"); });
  loop.deliver_signal(SIGINT);
  loop.run_until_idle();
  EXPECT_EQ(order, (std::vector<std::string>{"signal", "output", "exit", "timer", "post"}));
}

TEST(FakeEventLoop, RunJumpsToTheNextTimerUntilQuit) {
  FakeEventLoop loop;
  const auto timer = loop.after(1h, [&] { loop.quit(); });
  loop.run();
  EXPECT_EQ(loop.now(), 1h);
}

TEST(FakeEventLoop, RunRefusesToWaitForEver) {
  FakeEventLoop loop;
  EXPECT_THROW(loop.run(), std::logic_error);
}

TEST(FakeEventLoop, RefusesASignalThatNobodyWatches) {
  FakeEventLoop loop;
  EXPECT_THROW(loop.deliver_signal(SIGINT), std::logic_error);
}

}  // namespace
}  // namespace launch
