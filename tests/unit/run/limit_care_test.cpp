// SPDX-License-Identifier: Apache-2.0
// What a launch says of limits that a cgroup holds. A directory stands in for the cgroup file system.
#include "launcher/run/limits/limit_care.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "launcher/process/fake/fake_event_loop.hpp"

namespace launch {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class LimitCareTest : public testing::Test {
 protected:
  LimitCareTest() {
    tree_ = root_ / fmt::format("launch-{}-limits", ::getpid());
    put(tree_ / "cgroup.controllers", "cpu io memory pids\n");
    care_.use_place([this] { return ControlGroupPlace{.directory = root_.string()}; });
    spec_.name = "talker";
    spec_.control_limits = {.memory_max = 100U << 20U, .memory_high = 80U << 20U, .pids_max = 9};
    care_.prepare(spec_, 1);
    group_ = spec_.limits.control_group;
    put(group_ / "memory.events", "high 1\noom_kill 0\n");
    put(group_ / "pids.events", "max 2\n");
    event(ProcessStarted{77});
  }
  ~LimitCareTest() override { fs::remove_all(root_); }

  static void put(const fs::path& path, const std::string& text) {
    fs::create_directories(path.parent_path());
    std::ofstream(path) << text;
  }
  void event(decltype(ProcessEvent::what) what) { care_.on_event(ProcessEvent{1, label_, spec_, std::move(what)}); }
  std::vector<std::string> said() { return std::exchange(said_, {}); }

  fs::path root_ = fs::path(testing::TempDir()) / ("limit_care_" + std::to_string(::getpid()));
  fs::path tree_;
  fs::path group_;
  FakeEventLoop loop_;
  std::vector<std::string> said_;
  const std::string label_ = "talker-1";
  ProcessSpec spec_;
  LimitCare care_{loop_, [this](LogLevel, const std::string& logger, const std::string& text) {
                    said_.push_back(logger + ": " + text);
                  }};
};

TEST_F(LimitCareTest, TheProcessStartsInItsCgroup) {
  EXPECT_EQ(group_, tree_ / "talker-1");
  EXPECT_THAT(launch_exec_arguments(spec_.limits), ElementsAre("g" + group_.string(), "-"));
}

TEST_F(LimitCareTest, ALimitThatIsNearIsSaidOnce) {
  put(group_ / "memory.current", std::to_string(70U << 20U));
  loop_.advance(10s);
  EXPECT_THAT(said(), IsEmpty());
  put(group_ / "memory.current", std::to_string(95U << 20U));
  loop_.advance(10s);
  EXPECT_THAT(said(), ElementsAre(HasSubstr("talker-1: it uses 95.0 MiB of its memory_max of 100.0 MiB")));
}

TEST_F(LimitCareTest, AGroupThatIsNearItsLimitIsSaidOnce) {
  ProcessSpec spec;
  spec.name = "listener";
  spec.control_groups = {
      std::make_shared<const ControlGroup>(ControlGroup{.limits = {.memory_max = 100U << 20U}, .where = {}})};
  const std::string label = "listener-2";
  care_.prepare(spec, 2);
  care_.on_event(ProcessEvent{2, label, spec, ProcessStarted{78}});
  put(fs::path(spec.limits.control_group).parent_path() / "memory.current", std::to_string(91U << 20U));
  loop_.advance(10s);
  EXPECT_THAT(said(), ElementsAre(HasSubstr("listener-2: its group uses 91.0 MiB of its memory_max of 100.0 MiB")));
}

TEST_F(LimitCareTest, WhatTheKernelHasDoneInThisRunIsSaidOnce) {
  put(group_ / "memory.current", std::to_string(81U << 20U));
  loop_.advance(10s);
  EXPECT_THAT(said(), IsEmpty()) << "it was in a run before";
  put(group_ / "memory.events", "high 5\n");
  put(group_ / "pids.events", "max 3\n");
  loop_.advance(10s);
  EXPECT_THAT(said(),
              ElementsAre(HasSubstr("talker-1: it has exceeded its memory_high of 80.0 MiB: the kernel slows it"),
                          HasSubstr("talker-1: it has reached its pids_max of 9: the kernel has refused it")));
}

TEST_F(LimitCareTest, AnEndForWantOfMemoryIsCalledSo) {
  ProcessExit exit;
  exit.code = -9;
  exit.out_of_memory = true;
  event(ProcessExited{77, exit, false, false});
  EXPECT_THAT(
      said(),
      ElementsAre(HasSubstr("talker-1: the kernel has ended it, because it had used up its memory_max of 100.0 MiB")));
  put(group_ / "memory.current", std::to_string(99U << 20U));
  loop_.advance(60s);
  EXPECT_THAT(said(), IsEmpty()) << "nothing runs";
}

}  // namespace
}  // namespace launch
