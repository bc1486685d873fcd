// SPDX-License-Identifier: Apache-2.0
#include "launcher/process/output/screen.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <signal.h>
#include <stdlib.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <termios.h>
#include <unistd.h>

#include <array>
#include <string>

#include "base/files/pipe.hpp"
#include "launcher/process/fake/fake_event_loop.hpp"

namespace launch {
namespace {

using namespace std::chrono_literals;

constexpr Screen::Limits kSmall{.queue = 1000, .wait_for_room = 1ms, .wait_at_the_end = 1ms};

std::string lines(std::size_t count, std::size_t from = 0) {
  std::string text;
  for (std::size_t i = from; i < from + count; ++i) {
    text += "line " + std::to_string(i) + "\n";
  }
  return text;
}

class ScreenTest : public testing::Test {
 protected:
  ScreenTest() { ::signal(SIGPIPE, SIG_IGN); }

  // A reader that has not read: the pipe takes nothing more.
  void fill() {
    ASSERT_EQ(::fcntl(pipe.write.get(), F_SETPIPE_SZ, 4096), 4096);
    const std::string full(4096, '.');
    ASSERT_EQ(::write(pipe.write.get(), full.data(), full.size()), 4096);
  }
  std::string read() const {
    std::string text;
    std::array<char, 4096> buffer{};
    pollfd readable{pipe.read.get(), POLLIN, 0};
    while (::poll(&readable, 1, 0) == 1 && (readable.revents & POLLIN) != 0) {
      text.append(buffer.data(), static_cast<std::size_t>(::read(pipe.read.get(), buffer.data(), buffer.size())));
    }
    return text;
  }
  // What is shown until nothing more waits.
  std::string read_all() {
    std::string text;
    while (true) {
      loop.run_until_idle();
      const std::string more = read();
      if (more.empty()) {
        return text;
      }
      text += more;
    }
  }
  static std::string after_fill(const std::string& text) {
    return text.substr(std::min<std::size_t>(4096, text.size()));
  }

  Pipe pipe = make_pipe();
  FakeEventLoop loop;
};

TEST_F(ScreenTest, ShowsLinesAtOnceWhenTheScreenTakesThem) {
  Screen screen(pipe.write.get(), &loop, kSmall);
  EXPECT_TRUE(screen.print("one\n", false));
  EXPECT_EQ(read(), "one\n");
}

TEST_F(ScreenTest, LeavesTheDescriptorBlockingForOthers) {
  const Screen screen(pipe.write.get(), &loop, kSmall);
  EXPECT_EQ(::fcntl(pipe.write.get(), F_GETFL) & O_NONBLOCK, 0);
}

TEST_F(ScreenTest, KeepsLinesInAQueueUntilTheyAreRead) {
  Screen screen(pipe.write.get(), &loop, kSmall);
  fill();
  EXPECT_TRUE(screen.print("one\n", false));
  EXPECT_TRUE(screen.print("two\n", true));
  EXPECT_EQ(after_fill(read_all()), "one\ntwo\n");
}

TEST_F(ScreenTest, WritesTheQueueWithoutALoop) {
  Screen screen(pipe.write.get(), nullptr, kSmall);
  fill();
  EXPECT_TRUE(screen.print("one\n", false));
  EXPECT_EQ(after_fill(read()), "");
  EXPECT_TRUE(screen.print("two\n", false));
  EXPECT_EQ(read(), "one\ntwo\n");
}

TEST_F(ScreenTest, DropsWholeLinesWhileNobodyReadsAndSaysHowMany) {
  Screen screen(pipe.write.get(), &loop, kSmall);
  screen.tell_of_dropped([](std::size_t count) { return "dropped " + std::to_string(count) + "\n"; });
  fill();
  EXPECT_TRUE(screen.print(lines(100), false));  // 790 bytes
  EXPECT_FALSE(screen.print(lines(50, 100), false));
  EXPECT_FALSE(screen.print(lines(1, 150), false));
  EXPECT_EQ(after_fill(read_all()), lines(100) + "dropped 51\n");
  EXPECT_TRUE(screen.print("goes on\n", false));
  EXPECT_EQ(read_all(), "goes on\n");
}

TEST_F(ScreenTest, TakesALineThatIsLongerThanTheQueue) {
  Screen screen(pipe.write.get(), &loop, kSmall);
  const std::string line = std::string(100'000, 'x') + "\n";
  EXPECT_TRUE(screen.print(line, false));
  EXPECT_EQ(read_all(), line);
}

TEST_F(ScreenTest, IsGoneWhenItsReaderIsGone) {
  Screen screen(pipe.write.get(), &loop, kSmall);
  pipe.read.reset();
  EXPECT_FALSE(screen.print("one\n", false));
  EXPECT_TRUE(screen.is_gone());
  EXPECT_FALSE(screen.print("two\n", false));
}

TEST_F(ScreenTest, IsGoneWhenItsReaderGoesWhileLinesWait) {
  Screen screen(pipe.write.get(), &loop, kSmall);
  fill();
  EXPECT_TRUE(screen.print("one\n", false));
  pipe.read.reset();
  loop.run_until_idle();
  EXPECT_TRUE(screen.is_gone());
}

TEST_F(ScreenTest, TellsAtTheEndWhatWasNotTaken) {
  Screen screen(pipe.write.get(), &loop, kSmall);
  fill();
  EXPECT_TRUE(screen.print("logged\n", true));
  EXPECT_TRUE(screen.print("unlogged\n", false));
  const Screen::Rest rest = screen.finish();
  EXPECT_EQ(rest.unlogged, "unlogged\n");
  EXPECT_EQ(rest.lines, 2U);
  EXPECT_FALSE(screen.print("late\n", false));
}

TEST_F(ScreenTest, WritesTheQueueAtTheEnd) {
  Screen screen(pipe.write.get(), &loop, kSmall);
  fill();
  EXPECT_TRUE(screen.print("last\n", false));
  const std::string before = read();
  EXPECT_EQ(screen.finish().lines, 0U);
  EXPECT_EQ(after_fill(before + read()), "last\n");
}

TEST_F(ScreenTest, NeverWaitsForATerminalThatIsStopped) {
  const UniqueFd terminal(::posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC));
  ASSERT_EQ(::grantpt(terminal.get()), 0);
  ASSERT_EQ(::unlockpt(terminal.get()), 0);
  const UniqueFd fd(::open(::ptsname(terminal.get()), O_RDWR | O_NOCTTY | O_CLOEXEC));
  ASSERT_TRUE(fd);
  ASSERT_EQ(::tcflow(fd.get(), TCOOFF), 0);
  Screen screen(fd.get(), &loop, kSmall);
  EXPECT_TRUE(screen.print("one\n", false));
  EXPECT_FALSE(screen.print(lines(1000), false));
  EXPECT_FALSE(screen.is_gone());
  ASSERT_EQ(::tcflow(fd.get(), TCOON), 0);
  loop.run_until_idle();
  std::array<char, 100> text{};
  EXPECT_EQ(::read(terminal.get(), text.data(), text.size()), 5);
  EXPECT_STREQ(text.data(), "one\r\n");
}

TEST_F(ScreenTest, NeverWaitsForTheReaderOfASocket) {
  std::array<int, 2> fds{};
  ASSERT_EQ(::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, fds.data()), 0);
  const UniqueFd one(fds[0]);
  UniqueFd other(fds[1]);
  Screen screen(one.get(), &loop, kSmall);
  int taken = 0;
  while (screen.print(lines(100), false)) {
    ++taken;
  }
  EXPECT_GT(taken, 1);
  EXPECT_FALSE(screen.is_gone());
  EXPECT_EQ(::fcntl(one.get(), F_GETFL) & O_NONBLOCK, 0);
  other.reset();
  loop.run_until_idle();
  EXPECT_TRUE(screen.is_gone());
}

class StatusLineOfScreen : public ScreenTest {
 protected:
  StatusLineOfScreen() {
    ::setenv("TERM", "xterm", 1);
    EXPECT_EQ(::grantpt(terminal.get()), 0);
    EXPECT_EQ(::unlockpt(terminal.get()), 0);
    fd.reset(::open(::ptsname(terminal.get()), O_RDWR | O_NOCTTY | O_CLOEXEC));
  }
  // What the terminal shows. It gets the text a moment after the write, so this waits for as many bytes.
  std::string shown(std::size_t size) const {
    constexpr int kPatienceMs = 60'000;
    std::string all;
    std::array<char, 4096> text{};
    pollfd readable{terminal.get(), POLLIN, 0};
    while (all.size() < size && ::poll(&readable, 1, kPatienceMs) == 1) {
      const ssize_t count = ::read(terminal.get(), text.data(), text.size());
      if (count <= 0) {
        break;
      }
      all.append(text.data(), static_cast<std::size_t>(count));
    }
    return all;
  }
  void expect_shown(const std::string& text) const { EXPECT_EQ(shown(text.size()), text); }
  bool shows_nothing() const {
    pollfd readable{terminal.get(), POLLIN, 0};
    return ::poll(&readable, 1, 0) == 0;
  }

  UniqueFd terminal{::posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC)};
  UniqueFd fd;
};

TEST_F(StatusLineOfScreen, IsOverwrittenInPlaceAndStaysBelowTheOtherLines) {
  Screen screen(fd.get(), &loop, kSmall);
  ASSERT_TRUE(screen.can_show_status());
  screen.show_status("starting 1 of 3");
  expect_shown("\rstarting 1 of 3\033[K");
  screen.show_status("starting 2 of 3");
  screen.show_status("starting 2 of 3");
  expect_shown("\rstarting 2 of 3\033[K");
  EXPECT_TRUE(screen.print("[a-1] text\n", false));
  expect_shown("\r\033[K[a-1] text\r\n\rstarting 2 of 3\033[K");
  screen.show_status("");
  expect_shown("\r\033[K");
  EXPECT_TRUE(screen.print("[a-1] more\n", false));
  expect_shown("[a-1] more\r\n");
}

TEST_F(StatusLineOfScreen, FitsIntoTheTerminal) {
  const winsize narrow{24, 10, 0, 0};
  ASSERT_EQ(::ioctl(fd.get(), TIOCSWINSZ, &narrow), 0);
  Screen screen(fd.get(), &loop, kSmall);
  screen.show_status("b\u00e4\u00e4\n56789 and more");
  expect_shown("\rb\u00e4\u00e4?56789\033[K");
}

TEST_F(StatusLineOfScreen, IsErasedAtTheEnd) {
  Screen screen(fd.get(), &loop, kSmall);
  screen.show_status("stopping");
  expect_shown("\rstopping\033[K");
  EXPECT_EQ(screen.finish().lines, 0U);
  expect_shown("\r\033[K");
}

TEST_F(StatusLineOfScreen, WaitsUntilAStoppedTerminalGoesOn) {
  Screen screen(fd.get(), &loop, {});
  screen.show_status("starting 1 of 3");
  expect_shown("\rstarting 1 of 3\033[K");
  ASSERT_EQ(::tcflow(fd.get(), TCOOFF), 0);
  EXPECT_TRUE(screen.print("text\n", false));
  screen.show_status("starting 2 of 3");
  EXPECT_TRUE(shows_nothing());
  ASSERT_EQ(::tcflow(fd.get(), TCOON), 0);
  loop.run_until_idle();
  expect_shown("\r\033[Ktext\r\n\rstarting 2 of 3\033[K");
}

TEST_F(StatusLineOfScreen, IsForTerminalsOnly) {
  Screen screen(pipe.write.get(), &loop, kSmall);
  EXPECT_FALSE(screen.can_show_status());
  screen.show_status("starting 1 of 3");
  EXPECT_EQ(read(), "");
  ::setenv("TERM", "dumb", 1);
  EXPECT_FALSE(Screen(fd.get(), &loop, kSmall).can_show_status());
}

}  // namespace
}  // namespace launch
