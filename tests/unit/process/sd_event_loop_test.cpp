// SPDX-License-Identifier: Apache-2.0
#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/eventfd.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "base/files/unique_fd.hpp"
#include "launcher/process/event_loop.hpp"

namespace launch {
namespace {

using namespace std::chrono_literals;

class SdEventLoop : public testing::Test {
 protected:
  struct Pipe {
    Pipe() {
      std::array<int, 2> fds{};
      EXPECT_EQ(::pipe2(fds.data(), O_CLOEXEC | O_NONBLOCK), 0);
      out.reset(fds[0]);
      in.reset(fds[1]);
    }
    void write(const std::string& text) const {
      EXPECT_EQ(::write(in.get(), text.data(), text.size()), static_cast<ssize_t>(text.size()));
    }
    std::string read(std::size_t limit) const {
      std::string text(limit, '\0');
      text.resize(static_cast<std::size_t>(std::max<ssize_t>(::read(out.get(), text.data(), limit), 0)));
      return text;
    }
    UniqueFd out;
    UniqueFd in;
  };

  std::unique_ptr<EventLoop> loop = make_sd_event_loop();
};

TEST_F(SdEventLoop, CallsBackAgainWhileADescriptorIsReadable) {
  const Pipe pipe;
  pipe.write("abc");
  std::string read;
  const auto source = loop->on_readable(pipe.out.get(), [&] {
    read += pipe.read(1) + ".";
    if (read == "a.b.c.") {
      loop->quit();
    }
  });
  loop->run();
  EXPECT_EQ(read, "a.b.c.");
}

TEST_F(SdEventLoop, CallsBackAtTheEndOfAFile) {
  Pipe pipe;
  bool ended = false;
  const auto source = loop->on_readable(pipe.out.get(), [&] {
    char byte = 0;
    ended = ::read(pipe.out.get(), &byte, 1) == 0;
    loop->quit();
  });
  loop->post([&] { pipe.in.reset(); });
  loop->run();
  EXPECT_TRUE(ended);
}

TEST_F(SdEventLoop, CallsBackWhenADescriptorTakesBytesAgain) {
  const Pipe pipe;
  const std::string full(static_cast<std::size_t>(::fcntl(pipe.in.get(), F_GETPIPE_SZ)), '.');
  pipe.write(full);
  std::string order;
  const auto writable = loop->on_writable(pipe.in.get(), [&] {
    order += "writable";
    loop->quit();
  });
  const auto timer = loop->after(2ms, [&] {
    order += "read, ";
    pipe.read(full.size());
  });
  loop->run();
  EXPECT_EQ(order, "read, writable");
}

TEST_F(SdEventLoop, RefusesABadDescriptor) {
  EXPECT_THROW(static_cast<void>(loop->on_readable(-1, [] {})), std::system_error);
}

TEST_F(SdEventLoop, RunsTimersInOrderAndNeverEarly) {
  std::vector<int> order;
  const Duration start = loop->now();
  const auto late = loop->after(5ms, [&] {
    order.push_back(2);
    EXPECT_GE(loop->now() - start, 5ms);
    loop->quit();
  });
  const auto early = loop->after(1ms, [&] {
    order.push_back(1);
    EXPECT_GE(loop->now() - start, 1ms);
  });
  const auto for_ever = loop->after(Duration::max(), [&] { order.push_back(3); });
  loop->run();
  EXPECT_EQ(order, (std::vector<int>{1, 2}));
}

TEST_F(SdEventLoop, CancelsATimerWhenItsSourceIsDestroyed) {
  auto cancelled = loop->after(0s, [] { FAIL(); });
  cancelled.reset();
  const auto last = loop->after(2ms, [&] { loop->quit(); });
  loop->run();
}

TEST_F(SdEventLoop, ASourceMayBeDestroyedInItsOwnCallback) {
  const Pipe pipe;
  pipe.write("x");
  int calls = 0;
  EventLoop::SourcePtr timer;
  EventLoop::SourcePtr readable;
  // If the callback were destroyed with the source, the captured string would be used after its end.
  const std::string text = "a text that is too long for the small string optimisation";
  timer = loop->after(0s, [&, text] {
    timer.reset();
    ++calls;
    EXPECT_EQ(text.size(), 57U);
  });
  readable = loop->on_readable(pipe.out.get(), [&, text] {
    readable.reset();
    ++calls;
    EXPECT_EQ(text.size(), 57U);
    loop->post([&] { loop->quit(); });
  });
  loop->run();
  EXPECT_EQ(calls, 2);
}

TEST_F(SdEventLoop, DeliversSignalsBeforeOtherWork) {
  const Pipe pipe;
  std::vector<std::string> order;
  const auto signals = loop->on_signal(
      {SIGUSR1, SIGUSR2}, [&](EventLoop::Signal signal) { order.push_back(std::to_string(signal.number)); });
  const auto readable = loop->on_readable(pipe.out.get(), [&] {
    order.push_back("readable " + pipe.read(10));
    loop->quit();
  });
  pipe.write("x");
  ::raise(SIGUSR2);
  loop->run();
  EXPECT_EQ(order, (std::vector<std::string>{std::to_string(SIGUSR2), "readable x"}));
}

class ExitedChildren {
 public:
  explicit ExitedChildren(int count) {
    for (int i = 0; i < count; ++i) {
      const pid_t pid = ::fork();
      if (pid == 0) {
        ::_exit(0);
      }
      siginfo_t info{};
      ::waitid(P_PID, static_cast<id_t>(pid), &info, WEXITED | WNOWAIT);
      pids_.push_back(pid);
      pidfds.emplace_back(static_cast<int>(::syscall(SYS_pidfd_open, pid, 0)));
    }
  }
  ~ExitedChildren() {
    for (const pid_t pid : pids_) {
      ::waitpid(pid, nullptr, 0);
    }
  }

  std::vector<UniqueFd> pidfds;

 private:
  std::vector<pid_t> pids_;
};

TEST_F(SdEventLoop, DeliversExitsAfterOutputThatIsReadable) {
  constexpr int kCount = 20;
  const ExitedChildren children(kCount);
  const std::vector<Pipe> pipes(kCount);
  std::vector<std::string> order;
  std::vector<EventLoop::SourcePtr> sources;
  for (int i = 0; i < kCount; ++i) {
    const Pipe& pipe = pipes[static_cast<std::size_t>(i)];
    pipe.write("x");
    sources.push_back(loop->on_exit(children.pidfds[static_cast<std::size_t>(i)].get(), [&] {
      order.push_back("exit");
      if (order.size() == 2 * kCount) {
        loop->quit();
      }
    }));
    sources.push_back(loop->on_readable(pipe.out.get(), [&] { order.push_back("output " + pipe.read(10)); }));
  }
  loop->run();
  EXPECT_EQ(order[kCount - 1], "output x");
  EXPECT_EQ(order[kCount], "exit");
  EXPECT_EQ(order.back(), "exit");
}

TEST_F(SdEventLoop, DeliversAnExitOnlyOnceAndNotWhenCancelled) {
  const ExitedChildren children(2);
  int exits = 0;
  EventLoop::SourcePtr second;
  const auto first = loop->on_exit(children.pidfds[0].get(), [&] {
    ++exits;
    second.reset();
    loop->post([&] { loop->post([&] { loop->quit(); }); });
  });
  second = loop->on_exit(children.pidfds[1].get(), [] { FAIL(); });
  loop->run();
  EXPECT_EQ(exits, 1);
}

TEST_F(SdEventLoop, RunsPostsOfOtherThreads) {
  constexpr int kPosts = 1000;
  int count = 0;
  const auto work = [&] {
    for (int i = 0; i < kPosts; ++i) {
      loop->post([&] {
        if (++count == 2 * kPosts) {
          loop->quit();
        }
      });
    }
  };
  std::thread first(work);
  std::thread second(work);
  loop->run();
  first.join();
  second.join();
  EXPECT_EQ(count, 2 * kPosts);
}

TEST_F(SdEventLoop, RunsAPostOfACallbackInALaterTurn) {
  std::vector<int> order;
  loop->post([&] {
    loop->post([&] {
      order.push_back(2);
      loop->quit();
    });
    order.push_back(1);
  });
  loop->run();
  EXPECT_EQ(order, (std::vector<int>{1, 2}));
}

TEST_F(SdEventLoop, AnExceptionOfACallbackLeavesRunAndTheLoopCanGoOn) {
  loop->post([] { throw std::runtime_error("in a callback"); });
  loop->post([&] { loop->quit(); });
  EXPECT_THROW(loop->run(), std::runtime_error);
  loop->run();
}

TEST_F(SdEventLoop, QuitBeforeRunEndsTheNextRun) {
  loop->quit();
  loop->run();
}

}  // namespace
}  // namespace launch
