// SPDX-License-Identifier: Apache-2.0
// A real terminal, and this test in the place of the process.
#include "launcher/process/tty/process_tty.hpp"

#include <gtest/gtest.h>
#include <pty.h>
#include <sys/ioctl.h>
#include <termios.h>
#include <unistd.h>

#include <array>

namespace launch {
namespace {

class ProcessTtyTest : public testing::Test {
 protected:
  ProcessTtyTest() : loop_(make_sd_event_loop()) {
    int master = -1;
    int slave = -1;
    EXPECT_EQ(::openpty(&master, &slave, nullptr, nullptr, nullptr), 0);
    master_.reset(master);
    slave_.reset(slave);
    termios raw{};
    ::tcgetattr(slave, &raw);
    ::cfmakeraw(&raw);
    ::tcsetattr(slave, TCSANOW, &raw);
    EXPECT_EQ(::ioctl(master, FIONBIO, std::array<int, 1>{1}.data()), 0);
    tty_.begin(master);
  }
  std::string read() const {
    std::array<char, 64 * 1024> bytes{};
    const ssize_t count = ::read(slave_.get(), bytes.data(), bytes.size());
    return {bytes.data(), static_cast<std::size_t>(count > 0 ? count : 0)};
  }

  std::unique_ptr<EventLoop> loop_;
  UniqueFd master_;
  UniqueFd slave_;
  ProcessTty tty_{*loop_};
};

TEST_F(ProcessTtyTest, TypesAndSetsTheSize) {
  EXPECT_EQ(tty_.path(), ::ttyname(slave_.get()));
  EXPECT_EQ(tty_.type("ls\r"), 3U);
  EXPECT_EQ(read(), "ls\r");
  tty_.resize({.columns = 132, .lines = 50});
  winsize size{};
  ASSERT_EQ(::ioctl(slave_.get(), TIOCGWINSZ, &size), 0);
  EXPECT_EQ(size.ws_col, 132);
  EXPECT_EQ(size.ws_row, 50);
  tty_.resize({});
  ASSERT_EQ(::ioctl(slave_.get(), TIOCGWINSZ, &size), 0);
  EXPECT_EQ(size.ws_col, 132) << "a client without a terminal";
}

TEST_F(ProcessTtyTest, WhatTheProcessDoesNotReadWaits) {
  const std::string text(1'000'000, 'x');
  std::size_t taken = tty_.type(text);
  EXPECT_GT(taken, 0U);
  EXPECT_LT(taken, text.size());
  std::size_t got = 0;
  std::function<void()> type_on = [&] {
    taken += tty_.type(std::string_view(text).substr(taken));
    if (taken < text.size()) {
      tty_.when_room(type_on);
    }
  };
  tty_.when_room(type_on);
  const EventLoop::SourcePtr reader = loop_->on_readable(slave_.get(), [&] {
    got += read().size();
    if (got == text.size()) {
      loop_->quit();
    }
  });
  loop_->run();
  EXPECT_EQ(taken, text.size());
}

TEST_F(ProcessTtyTest, TheEndOfARunIsToldToWhoWaits) {
  bool told = false;
  tty_.when_room([&] { told = true; });
  tty_.end();
  EXPECT_TRUE(told);
  EXPECT_FALSE(tty_.is_open());
  EXPECT_EQ(tty_.type("lost"), 0U);
}

TEST_F(ProcessTtyTest, ShowsWhatWasPrintedUntilTheNextRun) {
  std::string seen;
  tty_.add_output("before\r\n");
  tty_.observe([&](std::string_view bytes) { seen += bytes; });
  tty_.add_output("\033[?2004h> ");
  EXPECT_EQ(seen, "\033[?2004h> ");
  EXPECT_EQ(tty_.picture(24), "\033[?2004hbefore\r\n\033[?2004h> ");
  EXPECT_EQ(tty_.picture(1), "\033[?2004h\033[?2004h> ");
  EXPECT_EQ(tty_.last_lines(2), "before\r\n\033[?2004h> ");
  tty_.add_output("\033[?1049h");
  EXPECT_EQ(tty_.picture(24), "\033[?2004h\033[?1049h") << "the program draws again";
  tty_.begin(master_.get());
  EXPECT_EQ(tty_.picture(24), "");
}

}  // namespace
}  // namespace launch
