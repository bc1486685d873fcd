// SPDX-License-Identifier: Apache-2.0
// The reader of live sessions, where LTTng's description of a process comes in parts.
#include "tracing/decode/reader/live_reader.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fstream>
#include <sstream>

#include "tests/support/command.hpp"
#include "tests/support/sandbox.hpp"

namespace tracing {
namespace {

namespace fs = std::filesystem;
using test_support::CommandResult;
using test_support::run_command;
using test_support::RunningCommand;
using Clock = std::chrono::steady_clock;

constexpr std::chrono::seconds kPatience{60};
constexpr int kPollMs = 10;  // the relay daemon does not tell when it has something

class LiveReaderTest : public ::testing::Test {
 protected:
  void run(const std::vector<std::string>& command) {
    const CommandResult result = run_command(command);
    ASSERT_EQ(result.exit_code, 0) << command[1] << result.out << result.err;
  }

  // Whether the relay daemon has got a description with this text.
  bool is_described(const std::string& text) const {
    for (const auto& entry : fs::recursive_directory_iterator(relayed_)) {
      if (entry.path().filename() != "metadata") {
        continue;
      }
      std::ostringstream all;
      all << std::ifstream(entry.path()).rdbuf();
      if (all.str().find(text) != std::string::npos) {
        return true;
      }
    }
    return false;
  }

  test_support::Sandbox sandbox_;
  const fs::path relayed_ = sandbox_.directory() / "relayed";
};

// A process that runs before the session describes its events before their stream.
TEST_F(LiveReaderTest, WaitsForTheStreamOfTheEvents) {
  const std::string fifo = sandbox_.directory() / "fifo";
  ASSERT_EQ(::mkfifo(fifo.c_str(), 0600), 0);
  ::setenv("LTTNG_APP_SOCKET_TIMEOUT", "-1", 1);  // the session daemon waits for the process as long as the test does
  run({"lttng-relayd", "--daemonize", "--output=" + relayed_.string()});
  run({"lttng-sessiond", "--daemonize"});
  RunningCommand worker({.argv = {WORKER}, .environment = {{"LD_PRELOAD", HELD_CHANNEL}, {"HELD_CHANNEL", fifo}}});
  worker.write("1\n");
  ASSERT_TRUE(worker.wait_for_output("done")) << worker.err();
  run({"lttng", "create", "seen", "--live=50000"});
  run({"lttng", "enable-channel", "-u", "channel"});
  run({"lttng", "enable-event", "-u", "-c", "channel", "ros2*"});
  RunningCommand start({.argv = {"lttng", "start"}});

  LiveReader reader(live_address("seen"));
  TraceItem item;
  bool is_attached = false;
  const auto read = [&] {
    is_attached = is_attached || reader.attach();
    const LiveReader::State state = is_attached ? reader.next(item) : LiveReader::State::kNothingYet;
    if (state == LiveReader::State::kNothingYet) {
      ::poll(nullptr, 0, kPollMs);
    }
    return state;
  };
  const Clock::time_point give_up = Clock::now() + kPatience;
  while (!is_described("event {")) {
    ASSERT_EQ(read(), LiveReader::State::kNothingYet);
    ASSERT_LT(Clock::now(), give_up) << "the events are not described";
  }
  EXPECT_FALSE(is_described("stream {"));
  for (int i = 0; i < 5; ++i) {
    ASSERT_EQ(read(), LiveReader::State::kNothingYet);
  }

  ::close(::open(fifo.c_str(), O_WRONLY | O_CLOEXEC));
  EXPECT_EQ(start.wait().exit_code, 0) << start.err();
  LiveReader::State state = LiveReader::State::kNothingYet;
  while ((state = read()) == LiveReader::State::kNothingYet) {
    worker.write("1\n");  // what comes before it has attached is not read
    ASSERT_LT(Clock::now(), give_up) << "no event is read";
  }
  ASSERT_EQ(state, LiveReader::State::kItem);
  ASSERT_NE(item.event, nullptr);
  EXPECT_TRUE(item.event->name().starts_with("ros2:")) << item.event->name();

  worker.close_input();
  EXPECT_EQ(worker.wait().exit_code, 0);
  run({"lttng", "destroy", "seen"});
  while ((state = reader.next(item)) != LiveReader::State::kEnd) {
    ASSERT_LT(Clock::now(), give_up) << "no end is read";
  }
}

}  // namespace
}  // namespace tracing
