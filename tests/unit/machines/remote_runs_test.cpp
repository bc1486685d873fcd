// SPDX-License-Identifier: Apache-2.0
#include "launcher/machines/remote_runs.hpp"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <poll.h>
#include <unistd.h>

#include <random>
#include <string>
#include <vector>

#include "launcher/process/fake/fake_event_loop.hpp"
#include "launcher/process/process_runner.hpp"

namespace {

using namespace launch;

class RemoteRunsTest : public testing::Test {
 protected:
  // As from the agent.
  void say(FromAgent kind, const WireWriter& content) {
    WireReader reader(content.bytes());
    runs.receive(kind, reader);
  }
  void say_exit(std::uint32_t run, int code) {
    WireWriter content;
    content.u32(run);
    put(content, ProcessExit{.code = code});
    say(FromAgent::kExited, content);
  }

  Process start(const std::string& name = "talker") {
    ProcessSpec spec;
    spec.name = name;
    spec.machine = "arm";
    spec.argv = {"/bin/" + name};
    return runs.start(spec);
  }
  Process start_and_confirm() {
    Process process = start();
    say(FromAgent::kStarted, WireWriter().u32(process.run).i32(4711));
    runs.confirm(process);
    return process;
  }

  static bool is_readable(const Process& process) {
    pollfd look{process.pidfd.get(), POLLIN, 0};
    return ::poll(&look, 1, 0) == 1;
  }
  static std::string read_all(const UniqueFd& pipe) {
    std::string text;
    std::array<char, 65536> bytes{};
    for (ssize_t count = 0; (count = ::read(pipe.get(), bytes.data(), bytes.size())) > 0;) {
      text.append(bytes.data(), static_cast<std::size_t>(count));
    }
    return text;
  }
  std::uint32_t credit_given() {
    std::uint32_t sum = 0;
    for (const auto& [kind, bytes] : sent) {
      if (kind == ToAgent::kCredit) {
        WireReader reader(bytes);
        reader.u32();
        reader.u8();
        sum += reader.u32();
      }
    }
    return sum;
  }

  FakeEventLoop loop;
  std::vector<std::pair<ToAgent, std::string>> sent;
  RemoteRuns runs{loop, [this](ToAgent kind, const WireWriter& content) { sent.emplace_back(kind, content.bytes()); }};
};

TEST_F(RemoteRunsTest, AProcessStartsWhenTheAgentSaysSo) {
  Process process = start();
  EXPECT_TRUE(process.starting);
  EXPECT_FALSE(is_readable(process));
  say(FromAgent::kStarted, WireWriter().u32(process.run).i32(4711));
  EXPECT_TRUE(is_readable(process));
  runs.confirm(process);
  EXPECT_FALSE(is_readable(process));
  EXPECT_FALSE(process.starting);
  EXPECT_EQ(process.pid, 4711);
  say_exit(process.run, 3);
  EXPECT_TRUE(is_readable(process));
  EXPECT_EQ(runs.outcome(process).code, 3);
  EXPECT_EQ(runs.reap(process).code, 3);
  EXPECT_EQ(sent.back().first, ToAgent::kRelease);
}

TEST_F(RemoteRunsTest, AnExitThatComesWithTheStartIsNotLost) {
  Process process = start();
  say(FromAgent::kStarted, WireWriter().u32(process.run).i32(4711));
  say_exit(process.run, 1);
  runs.confirm(process);
  EXPECT_TRUE(is_readable(process));
}

TEST_F(RemoteRunsTest, AFailedStartHasTheTextOfTheAgent) {
  Process process = start();
  say(FromAgent::kFailed,
      WireWriter().u32(process.run).i32(ENOENT).text("no program 'x' in the PATH: No such file or directory"));
  try {
    runs.confirm(process);
    FAIL();
  } catch (const std::system_error& error) {
    EXPECT_STREQ(error.what(), "no program 'x' in the PATH: No such file or directory");
    EXPECT_EQ(error.code().value(), ENOENT);
  }
}

TEST_F(RemoteRunsTest, OutputComesThroughThePipesAndBeforeTheExit) {
  Process process = start_and_confirm();
  say(FromAgent::kOutput, WireWriter().u32(process.run).u8(0).rest("one\n"));
  say(FromAgent::kOutput, WireWriter().u32(process.run).u8(1).rest("two\n"));
  EXPECT_EQ(read_all(process.out), "one\n");
  EXPECT_EQ(read_all(process.err), "two\n");
  const std::string much(200'000, 'x');  // more than the pipe takes
  say(FromAgent::kOutput, WireWriter().u32(process.run).u8(0).rest(much));
  say(FromAgent::kClosed, WireWriter().u32(process.run).u8(0));
  say_exit(process.run, 0);
  EXPECT_FALSE(is_readable(process));
  std::string got;
  for (int turn = 0; turn < 20 && got.size() < much.size(); ++turn) {
    got += read_all(process.out);
    loop.run_until_idle();
  }
  EXPECT_EQ(got, much);
  EXPECT_TRUE(is_readable(process));
}

TEST_F(RemoteRunsTest, CreditComesBackOnlyForWhatIsRead) {
  Process process = start_and_confirm();
  const std::string window(kStreamWindow, 'x');
  say(FromAgent::kOutput, WireWriter().u32(process.run).u8(0).rest(window));
  loop.run_until_idle();
  EXPECT_LT(credit_given(), kStreamWindow / 2);
  EXPECT_THROW(say(FromAgent::kOutput, WireWriter().u32(process.run).u8(0).rest(window)), WireError);
  std::string got;
  for (int turn = 0; turn < 20 && got.size() < window.size(); ++turn) {
    got += read_all(process.out);
    loop.run_until_idle();
  }
  EXPECT_EQ(got.size(), window.size());
  EXPECT_GE(credit_given(), kStreamWindow * 3 / 4);
}

TEST_F(RemoteRunsTest, ALostConnectionEndsEverything) {
  Process running = start_and_confirm();
  Process starting = start("listener");
  EXPECT_EQ(runs.running_labels(), "talker, listener");
  runs.lose("the connection to machine 'arm' is lost");
  EXPECT_TRUE(is_readable(running));
  EXPECT_TRUE(runs.outcome(running).lost);
  EXPECT_EQ(runs.outcome(running).code, kExitCodeOfLost);
  EXPECT_THROW(runs.confirm(starting), NeverStarts);
  EXPECT_THROW(start("late"), NeverStarts);
}

TEST_F(RemoteRunsTest, WhatAnAgentMustNotSayEndsTheConnection) {
  EXPECT_THROW(say(FromAgent::kStarted, WireWriter().u32(1).i32(1)), WireError);  // never asked for
  Process process = start();
  EXPECT_THROW(say(FromAgent::kOutput, WireWriter().u32(process.run).u8(0).rest("x")), WireError);  // not started
  EXPECT_THROW(say(FromAgent::kStarted, WireWriter().u32(process.run).i32(0)), WireError);
  Process other = start_and_confirm();
  EXPECT_THROW(say(FromAgent::kStarted, WireWriter().u32(other.run).i32(1)), WireError);  // twice
  EXPECT_THROW(say(FromAgent::kOutput, WireWriter().u32(other.run).u8(2).rest("x")), WireError);
  say(FromAgent::kClosed, WireWriter().u32(other.run).u8(0));
  EXPECT_THROW(say(FromAgent::kOutput, WireWriter().u32(other.run).u8(0).rest("x")), WireError);
  say_exit(other.run, 0);
  EXPECT_THROW(say_exit(other.run, 0), WireError);
  EXPECT_THROW(say_exit(other.run, 4000), WireError);
}

TEST_F(RemoteRunsTest, RandomMessagesAreReadOrRefused) {
  std::vector<Process> processes;
  for (int i = 0; i < 5; ++i) {
    processes.push_back(start());
  }
  std::mt19937 random(7);
  for (int round = 0; round < 20000; ++round) {
    WireWriter content;
    content.u32(random() % 8).u8(static_cast<std::uint8_t>(random() % 3));
    for (unsigned more = random() % 40; more > 0; --more) {
      content.u8(static_cast<std::uint8_t>(random()));
    }
    try {
      say(static_cast<FromAgent>(random() % 11), content);
    } catch (const WireError&) {
      // refused
    }
  }
}

}  // namespace
