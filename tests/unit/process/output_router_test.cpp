// SPDX-License-Identifier: Apache-2.0
#include "launcher/process/output/output_router.hpp"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <filesystem>
#include <thread>

#include "base/files/pipe.hpp"
#include "memory_screen.hpp"
#include "temporary_directory.hpp"

namespace launch {
namespace {

using namespace std::chrono_literals;

class Router : public testing::Test {
 protected:
  OutputRouter make(LogLevel level = LogLevel::kInfo, bool colour = false) const {
    return OutputRouter(
        {.screen_fd = screen.fd(), .log_directory = logs.path(), .screen_level = level, .colour = colour});
  }
  void write(OutputRouter& router, std::string_view bytes, const char* mode = "screen",
             OutputStream stream = OutputStream::kOut) const {
    const OutputRouting routing = *OutputRouting::from_mode(mode);
    router.write(1, "a-1", stream, stream == OutputStream::kOut ? routing.out : routing.err, bytes);
  }
  bool has_log(const std::string& name) const { return std::filesystem::exists(logs.path() + "/" + name); }

  MemoryScreen screen;
  TemporaryDirectory logs;
};

TEST_F(Router, WritesWholeLinesOnly) {
  OutputRouter router = make();
  write(router, "first\nsec");
  EXPECT_EQ(screen.text(), "[a-1] first\n");
  write(router, "ond");
  EXPECT_EQ(screen.text(), "[a-1] first\n");
  write(router, "\n\nfourth\n");
  EXPECT_EQ(screen.text(), "[a-1] first\n[a-1] second\n[a-1] \n[a-1] fourth\n");
}

TEST_F(Router, WritesTheRestWhenTheStreamCloses) {
  OutputRouter router = make();
  write(router, "rest");
  router.close_stream(1, "a-1", OutputStream::kOut, {.screen = true});
  router.close_stream(1, "a-1", OutputStream::kOut, {.screen = true});
  EXPECT_EQ(screen.text(), "[a-1] rest\n");
}

TEST_F(Router, KeepsProcessesAndStreamsApart) {
  OutputRouter router = make();
  const OutputTargets targets{.screen = true};
  router.write(1, "a-1", OutputStream::kOut, targets, "a out ");
  router.write(2, "b-2", OutputStream::kOut, targets, "b out ");
  router.write(1, "a-1", OutputStream::kErr, targets, "a err\n");
  router.write(2, "b-2", OutputStream::kOut, targets, "end\n");
  router.write(1, "a-1", OutputStream::kOut, targets, "end\n");
  EXPECT_EQ(screen.text(), "[a-1] a err\n[b-2] b out end\n[a-1] a out end\n");
}

TEST_F(Router, DoesNotDamageCharactersThatAreSplitBetweenReads) {
  OutputRouter router = make();
  for (const char byte : std::string_view("\xE2\x82\xAC \xF0\x9F\x9A\x80\n")) {
    write(router, std::string_view(&byte, 1));
  }
  EXPECT_EQ(screen.text(), "[a-1] \xE2\x82\xAC \xF0\x9F\x9A\x80\n");
}

TEST_F(Router, ReplacesInvalidBytes) {
  OutputRouter router = make();
  write(router,
        "good\nb\xFF"
        "d \xE2\x82\nend\n");
  EXPECT_EQ(screen.text(),
            "[a-1] good\n[a-1] b\xEF\xBF\xBD"
            "d \xEF\xBF\xBD\n[a-1] end\n");
}

TEST_F(Router, KeepsCarriageReturnsAndEscapes) {
  OutputRouter router = make();
  write(router, "\033[31mred\033[0m\r\n");
  EXPECT_EQ(screen.text(), "[a-1] \033[31mred\033[0m\r\n");
}

TEST_F(Router, CutsALineThatNeverEnds) {
  OutputRouter router = make();
  const std::string part = std::string(700 * 1024 - 1, 'x') + "\xE2";
  write(router, part);
  EXPECT_EQ(screen.text(), "");
  write(router, "\x82\xAC" + part);
  write(router, "\x82\xAC\n");
  const std::string x(700 * 1024 - 1, 'x');
  EXPECT_EQ(screen.text(), "[a-1] " + x + "\xE2\x82\xAC" + x + "\n[a-1] \xE2\x82\xAC\n");
}

TEST_F(Router, SendsEachModeWhereRosSendsIt) {
  struct Case {
    const char* mode;
    bool out_screen, err_screen, out_log, err_log, own;
  };
  for (const Case& expected :
       {Case{"screen", true, true, false, false, false}, Case{"log", false, true, true, true, false},
        Case{"both", true, true, true, true, false}, Case{"own_log", false, false, false, false, true},
        Case{"full", true, true, true, true, true}}) {
    const OutputRouting routing = *OutputRouting::from_mode(expected.mode);
    EXPECT_EQ(routing.out, (OutputTargets{expected.out_screen, expected.out_log, expected.own})) << expected.mode;
    EXPECT_EQ(routing.err, (OutputTargets{expected.err_screen, expected.err_log, expected.own})) << expected.mode;
  }
  EXPECT_EQ(OutputRouting::from_mode("loud"), std::nullopt);
}

TEST_F(Router, WritesLaunchLogWithTimeStamps) {
  OutputRouter router = make();
  write(router, "one\ntwo\n", "log");
  EXPECT_EQ(screen.text(), "");
  EXPECT_THAT(logs.read("launch.log"),
              testing::MatchesRegex("[0-9]{10}\\.[0-9]{7} \\[a-1\\] one\n[0-9]{10}\\.[0-9]{7} \\[a-1\\] two\n"));
  EXPECT_FALSE(has_log("a-1.log"));
}

TEST_F(Router, WritesOwnLogs) {
  OutputRouter router = make();
  write(router, "out\n", "own_log");
  write(router, "err\n", "own_log", OutputStream::kErr);
  EXPECT_EQ(logs.read("a-1-stdout.log"), "[a-1] out\n");
  EXPECT_EQ(logs.read("a-1-stderr.log"), "[a-1] err\n");
  EXPECT_EQ(logs.read("a-1.log"), "[a-1] out\n[a-1] err\n");
  EXPECT_EQ(logs.read("launch.log"), "");
  EXPECT_EQ(screen.text(), "");
}

TEST_F(Router, GoesOnInTheSameOwnLogAfterARespawn) {
  OutputRouter router = make();
  const OutputTargets own{.own_log = true};
  for (const char* line : {"first\n", "second\n"}) {
    write(router, line, "own_log");
    router.close_stream(1, "a-1", OutputStream::kOut, own);
    router.close_stream(1, "a-1", OutputStream::kErr, own);
  }
  EXPECT_EQ(logs.read("a-1.log"), "[a-1] first\n[a-1] second\n");
}

TEST_F(Router, KeepsOwnLogsInTheDirectory) {
  OutputRouter router = make();
  router.write(1, "../a-1", OutputStream::kOut, {.own_log = true}, "x\n");
  EXPECT_EQ(logs.read(".._a-1.log"), "[../a-1] x\n");
}

TEST_F(Router, WritesNoFilesWithoutALogDirectory) {
  OutputRouter router({.screen_fd = screen.fd()});
  write(router, "x\n", "full");
  router.message(LogLevel::kInfo, "launch", "text");
  EXPECT_EQ(screen.text(), "[a-1] x\n[INFO] [launch]: text\n");
}

TEST_F(Router, FormatsLauncherMessages) {
  OutputRouter router = make();
  router.message(LogLevel::kDebug, "launch", "detail");
  router.message(LogLevel::kWarning, "a-1", "b\xFF");
  EXPECT_EQ(screen.text(), "[WARNING] [a-1]: b\xEF\xBF\xBD\n");
  EXPECT_THAT(logs.read("launch.log"),
              testing::MatchesRegex("[0-9]{10}\\.[0-9]{7} \\[DEBUG\\] \\[launch\\]: detail\n[0-9]{10}\\.[0-9]{7} "
                                    "\\[WARNING\\] \\[a-1\\]: b.*\n"));
}

TEST_F(Router, ColoursWarningsAndErrors) {
  OutputRouter router = make(LogLevel::kInfo, true);
  router.message(LogLevel::kInfo, "launch", "calm");
  router.message(LogLevel::kError, "launch", "bad");
  EXPECT_EQ(screen.text(), "[INFO] [launch]: calm\n\033[31m[ERROR] [launch]: bad\033[0m\n");
  EXPECT_EQ(logs.read("launch.log").find('\033'), std::string::npos);
}

TEST_F(Router, GoesOnWithTheLogWhenTheScreenIsGone) {
  std::array<int, 2> fds{};
  ASSERT_EQ(::pipe2(fds.data(), O_CLOEXEC), 0);
  const UniqueFd in(fds[1]);
  ::close(fds[0]);
  OutputRouter router({.screen_fd = in.get(), .log_directory = logs.path()});
  write(router, "one\n", "both");
  write(router, "two\n", "both");
  EXPECT_THAT(logs.read("launch.log"),
              testing::MatchesRegex("[0-9.]+ \\[WARNING\\] \\[launch\\]: the screen is gone, its lines follow here\n"
                                    "[0-9.]+ \\[a-1\\] one\n[0-9.]+ \\[a-1\\] two\n"));
}

TEST_F(Router, LogsWhatAScreenThatIsGoneDoesNotShow) {
  Pipe pipe = make_pipe();
  pipe.read.reset();
  OutputRouter router({.screen_fd = pipe.write.get(), .log_directory = logs.path()});
  write(router, "one\n");
  write(router, "two\n");
  EXPECT_THAT(logs.read("launch.log"),
              testing::MatchesRegex("[0-9.]+ \\[WARNING\\] \\[launch\\]: the screen is gone, its lines follow here\n"
                                    "[0-9.]+ \\[a-1\\] one\n[0-9.]+ \\[a-1\\] two\n"));
}

TEST_F(Router, LogsWhatAScreenThatIsNotReadDoesNotShow) {
  const Pipe pipe = make_pipe();
  const int size = ::fcntl(pipe.write.get(), F_SETPIPE_SZ, 4096);
  ASSERT_GT(size, 0);
  const Screen::Limits limits{.queue = 10, .wait_for_room = 1ms, .wait_at_the_end = 1ms};
  {
    OutputRouter router({.screen_fd = pipe.write.get(), .log_directory = logs.path(), .screen_limits = limits});
    write(router, std::string(static_cast<std::size_t>(size), 'x') + "\n");
    write(router, "one\n");
    write(router, "two\nthree\n", "both");
  }
  EXPECT_THAT(logs.read("launch.log"),
              testing::MatchesRegex("[0-9.]+ \\[a-1\\] one\n[0-9.]+ \\[a-1\\] two\n[0-9.]+ \\[a-1\\] three\n"
                                    "[0-9.]+ xxxxxx\n[0-9.]+ \\[WARNING\\] \\[launch\\]: the screen has not taken "
                                    "the last 4 lines\n"));
}

TEST_F(Router, ShowsErrorsInOrderWhereOutputAndErrorsAreOnePipe) {
  const Pipe pipe = make_pipe();
  {
    OutputRouter router({.screen_fd = pipe.write.get(), .error_fd = pipe.write.get()});
    write(router, "one\n");
    router.error("error\n");
    write(router, "two\n");
  }
  std::array<char, 100> text{};
  EXPECT_EQ(::read(pipe.read.get(), text.data(), text.size()), 26);
  EXPECT_STREQ(text.data(), "[a-1] one\nerror\n[a-1] two\n");
}

TEST_F(Router, LosesNothingOnASlowNonBlockingScreen) {
  std::array<int, 2> fds{};
  ASSERT_EQ(::pipe2(fds.data(), O_CLOEXEC | O_NONBLOCK), 0);
  UniqueFd in(fds[1]);
  const UniqueFd out(fds[0]);
  ::fcntl(out.get(), F_SETFL, 0);  // the reader waits
  std::string seen;
  std::thread reader([&] {
    std::array<char, 1000> buffer{};
    ssize_t size = 0;
    while ((size = ::read(out.get(), buffer.data(), buffer.size())) > 0) {
      seen.append(buffer.data(), static_cast<std::size_t>(size));
    }
  });
  std::string expected;
  {
    OutputRouter router({.screen_fd = in.get()});
    for (int i = 0; i < 20'000; ++i) {
      const std::string line = "line " + std::to_string(i) + "\n";
      write(router, line);
      expected += "[a-1] " + line;
    }
  }
  in.reset();
  reader.join();
  EXPECT_EQ(seen, expected);
}

TEST_F(Router, TellsOnceThatALogCannotBeWritten) {
  OutputRouter router = make();
  std::filesystem::create_directory(logs.path() + "/a-1.log");
  write(router, "x\n", "own_log");
  write(router, "y\n", "own_log");
  EXPECT_EQ(screen.text(), "[WARNING] [launch]: cannot write '" + logs.path() + "/a-1.log': Is a directory\n");
  EXPECT_EQ(logs.read("a-1-stdout.log"), "[a-1] x\n[a-1] y\n");
}

TEST_F(Router, BeginsANewLogFileBeforeOneGetsTooLarge) {
  const OutputRouter::Rotation rotation{.size = 20, .files = 3};
  OutputRouter router({.screen_fd = screen.fd(), .log_directory = logs.path(), .rotation = rotation});
  write(router, "1\n2\n3\n4\n5\n", "own_log");  // lines of eight bytes
  EXPECT_EQ(logs.read("a-1.log"), "[a-1] 5\n");
  EXPECT_EQ(logs.read("a-1.log.1"), "[a-1] 3\n[a-1] 4\n");
  EXPECT_EQ(logs.read("a-1.log.2"), "[a-1] 1\n[a-1] 2\n");
  write(router, "a line that is longer than a file\n6\n", "own_log");
  EXPECT_EQ(logs.read("a-1.log"), "[a-1] 6\n");
  EXPECT_EQ(logs.read("a-1.log.1"), "[a-1] a line that is longer than a file\n");
  EXPECT_EQ(logs.read("a-1.log.2"), "[a-1] 5\n");
  EXPECT_FALSE(has_log("a-1.log.3"));
}

TEST_F(Router, PutsTheTimeInFrontOfEachLineOfTheScreen) {
  OutputRouter router({.screen_fd = screen.fd(), .timestamps = true});
  write(router, "one\ntwo\n");
  router.message(LogLevel::kInfo, "launch", "text");
  EXPECT_THAT(screen.text(), testing::MatchesRegex("[0-9]{10}\\.[0-9]{7} \\[a-1\\] one\n[0-9]{10}\\.[0-9]{7} \\[a-1\\] "
                                                   "two\n[0-9]{10}\\.[0-9]{7} \\[INFO\\] \\[launch\\]: text\n"));
}

TEST_F(Router, FormatsMessagesAsTheUserWants) {
  OutputRouter router({.screen_fd = screen.fd(),
                       .log_directory = logs.path(),
                       .screen_format = MessageFormat("{levelno} {name}: {msg}"),
                       .log_format = MessageFormat("{msg}")});
  router.message(LogLevel::kError, "a-1", "text");
  EXPECT_EQ(screen.text(), "40 a-1: text\n");
  EXPECT_EQ(logs.read("launch.log"), "text\n");
}

TEST_F(Router, FailsClearlyWithoutItsDirectory) {
  const std::string missing = logs.path() + "/missing";
  try {
    const OutputRouter router({.screen_fd = 1, .log_directory = missing});
    FAIL();
  } catch (const std::system_error& error) {
    EXPECT_EQ(std::string(error.what()), "cannot create '" + missing + "/launch.log': No such file or directory");
  }
}

}  // namespace
}  // namespace launch
