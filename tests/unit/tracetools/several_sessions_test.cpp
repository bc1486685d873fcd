// SPDX-License-Identifier: Apache-2.0
// A session has each object once, whatever other sessions do meanwhile.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "tests/support/command.hpp"
#include "tests/support/emulated.hpp"
#include "tests/support/sandbox.hpp"

namespace {

using test_support::run_command;
using test_support::RunningCommand;
using testing::IsEmpty;

using Objects = std::multiset<unsigned>;

void run(const std::vector<std::string>& argv) {
  const auto result = run_command(argv);
  ASSERT_EQ(result.exit_code, 0) << testing::PrintToString(argv) << result.out << result.err;
}

// What a session is to hold: the list that the test keeps of the objects of the process.
class RecordedSession {
 public:
  RecordedSession(std::string name, std::filesystem::path directory)
      : name_(std::move(name)), directory_(std::move(directory)) {}

  void create(const std::string& events) {
    run({"lttng", "create", name_, "--output=" + directory_.string()});
    run({"lttng", "enable-event", "--userspace", events, "--session=" + name_});
  }
  void start(const Objects& living) {
    run({"lttng", "start", name_});
    // The process takes the commands of the session daemon one after the other. So it has dumped its state when the
    // daemon has its answer to another command.
    run({"lttng", "list", "--userspace"});
    running_ = true;
    for (const unsigned object : living) {
      if (!expected_.contains(object)) {
        expected_.insert(object);
      }
    }
  }
  void regenerate(const Objects& living) {
    run({"lttng", "regenerate", "statedump", "--session=" + name_});
    expected_.insert(living.begin(), living.end());
  }
  void stop() {
    run({"lttng", "stop", name_});
    running_ = false;
  }
  void destroy() { run({"lttng", "destroy", name_}); }
  bool running() const { return running_; }
  void object_made(unsigned object) {
    if (running_) {
      expected_.insert(object);
    }
  }

  const std::string& name() const { return name_; }
  const Objects& expected() const { return expected_; }
  // The objects of the init events in the trace.
  Objects recorded() const {
    const auto text = run_command({"babeltrace2", directory_.string()});
    EXPECT_EQ(text.exit_code, 0) << text.err;
    Objects objects;
    std::istringstream stream(text.out);
    for (std::string line; std::getline(stream, line);) {
      if (line.find(" ros2:rcl_timer_init:") == std::string::npos) {
        continue;
      }
      objects.insert(static_cast<unsigned>(std::stoul(line.substr(line.find("timer_handle = ") + 15), nullptr, 16)));
    }
    return objects;
  }

 private:
  std::string name_;
  std::filesystem::path directory_;
  bool running_ = false;
  Objects expected_;
};

struct SeveralSessions : testing::TestWithParam<unsigned> {
  void SetUp() override {
    run({"lttng-sessiond", "--daemonize"});
    process.emplace(test_support::Command{.argv = {OBJECTS_ON_COMMAND}});
  }
  void tell(const std::string& what, unsigned object) {
    const std::string line = what + " " + std::to_string(object) + "\n";
    process->write(line);
    ASSERT_TRUE(process->wait_for_output(line));
  }
  void make() {
    tell("make", ++last);
    living.insert(last);
  }
  void end_one() {
    if (living.empty()) {
      return;
    }
    tell("end", *living.begin());
    living.erase(living.begin());
  }
  RecordedSession session(const std::string& name) { return {name, sandbox.directory() / name}; }

  test_support::Sandbox sandbox;
  std::optional<RunningCommand> process;
  Objects living;
  unsigned last = 0;
};

TEST_F(SeveralSessions, GetNothingFromTheDumpsOfEachOther) {
  NEEDS_ITS_OWN_TRACER();
  make();
  RecordedSession first = session("first");
  first.create("ros2:*,ros2_ext:*");
  first.start(living);
  make();
  first.object_made(last);
  RecordedSession second = session("second");
  second.create("ros2:*");
  second.start(living);
  // Another user of LTTng, to whom the objects mean nothing.
  RecordedSession other = session("other");
  other.create("ros2:callback_*,ros2_ext:*");
  other.start({});
  second.stop();
  make();
  first.object_made(last);
  second.start(living);
  for (RecordedSession* each : {&first, &second, &other}) {
    each->stop();
  }
  for (RecordedSession* each : {&first, &second, &other}) {
    each->destroy();
  }
  EXPECT_EQ(first.recorded(), (Objects{1, 2, 3}));
  EXPECT_EQ(second.recorded(), (Objects{1, 2, 3}));
  EXPECT_THAT(run_command({"babeltrace2", (sandbox.directory() / "other").string()}).out, IsEmpty());
}

TEST_F(SeveralSessions, WithARuleForNoStateDumpHaveNewObjectsOnly) {
  make();
  RecordedSession runtime = session("runtime");
  runtime.create("ros2:*,ros2_session:no_state_dump");
  RecordedSession everything = session("everything");
  everything.create("ros2*");
  for (RecordedSession* each : {&runtime, &everything}) {
    each->start(living);
  }
  make();
  for (RecordedSession* each : {&runtime, &everything}) {
    each->stop();
  }
  for (RecordedSession* each : {&runtime, &everything}) {
    each->destroy();
  }
  EXPECT_EQ(runtime.recorded(), Objects{2});
  EXPECT_EQ(everything.recorded(), (Objects{1, 2}));
}

// Three sessions begin, pause, resume, ask again and end at random, while objects come and go.
TEST_P(SeveralSessions, HoldEachObjectOnce) {
  NEEDS_ITS_OWN_TRACER();
  std::mt19937 random(GetParam());
  const auto one_of = [&random](unsigned count) {
    return std::uniform_int_distribution<unsigned>(0, count - 1)(random);
  };
  std::vector<RecordedSession> ended;
  std::array<std::optional<RecordedSession>, 3> sessions;
  for (unsigned step = 0; step < 60; ++step) {
    std::optional<RecordedSession>& chosen = sessions.at(one_of(3));
    switch (one_of(6)) {
      case 0:
      case 1:
        make();
        for (auto& each : sessions) {
          if (each) {
            each->object_made(last);
          }
        }
        break;
      case 2:
        end_one();
        break;
      case 3:
        if (chosen && chosen->running()) {
          chosen->stop();
        }
        break;
      case 4:
        if (!chosen) {
          chosen.emplace(session("session" + std::to_string(step)));
          // The same rules in another order of channels and events give other addresses in the process.
          chosen->create(one_of(2) == 0 ? "ros2:*" : "ros2:rcl_timer_init");
        }
        if (!chosen->running()) {
          chosen->start(living);
        }
        break;
      default:
        if (chosen && chosen->running() && one_of(3) == 0) {
          chosen->regenerate(living);
        } else if (chosen && one_of(2) == 0) {
          chosen->destroy();
          ended.push_back(*std::exchange(chosen, std::nullopt));
        }
    }
    if (HasFatalFailure()) {
      return;
    }
  }
  for (auto& each : sessions) {
    if (!each) {
      continue;
    }
    each->destroy();
    ended.push_back(*each);
  }
  for (const RecordedSession& each : ended) {
    EXPECT_EQ(each.recorded(), each.expected()) << each.name();
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, SeveralSessions, testing::Range(0U, 6U));

}  // namespace
