// SPDX-License-Identifier: Apache-2.0
// Cgroups of a launch, in a directory that stands in for a cgroup file system; and what the kernel says of the end of
// processes.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "launcher/process/control_groups/control_group_tree.hpp"
#include "launcher/process/control_groups/control_group_use.hpp"
#include "launcher/process/control_groups/kernel_messages.hpp"

namespace launch {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

std::string contents(const fs::path& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

void put(const fs::path& path, const std::string& text) {
  fs::create_directories(path.parent_path());
  std::ofstream(path) << text;
}

class ControlGroups : public testing::Test {
 protected:
  ControlGroups() {
    fs::remove_all(root_);
    // In a real one, the controllers appear in the new directory by themselves.
    put(tree_path_ / "cgroup.controllers", "cpu io memory pids\n");
  }
  ~ControlGroups() override { fs::remove_all(root_); }
  ControlGroupTree tree(ControlGroupPlace place) {
    return ControlGroupTree([place] { return place; }, "42",
                            [this](const std::string& text) { warnings_.push_back(text); });
  }
  static std::shared_ptr<const ControlGroup> group(ControlGroupLimits limits) {
    return std::make_shared<const ControlGroup>(ControlGroup{limits, {}});
  }

  fs::path root_ = fs::path(testing::TempDir()) / ("control_groups_" + std::to_string(::getpid()));
  fs::path tree_path_ = root_ / "launch-42-limits";
  std::vector<std::string> warnings_;
};

TEST_F(ControlGroups, AProcessHasOneWithItsLimits) {
  ControlGroupTree made = tree({.directory = root_.string()});
  const fs::path path = made.make("left/talker-1",
                                  {.memory_max = 64U << 20U,
                                   .memory_high = 48U << 20U,
                                   .cpu_quota = 1.5,
                                   .cpu_weight = 50,
                                   .io_weight = 20,
                                   .pids_max = 7},
                                  {});
  EXPECT_EQ(path, tree_path_ / "left_talker-1");
  EXPECT_EQ(contents(path / "memory.max"), "67108864");
  EXPECT_EQ(contents(path / "memory.high"), "50331648");
  EXPECT_EQ(contents(path / "cpu.max"), "150000 100000");
  EXPECT_EQ(contents(path / "cpu.weight"), "50");
  EXPECT_EQ(contents(path / "io.weight"), "20");
  EXPECT_EQ(contents(path / "pids.max"), "7");
  EXPECT_THAT(warnings_, IsEmpty());
}

TEST_F(ControlGroups, ProcessesOfAGroupShareItsLimits) {
  ControlGroupTree made = tree({.directory = root_.string()});
  const auto outer = group({.memory_max = 1000});
  const auto inner = group({.pids_max = 5});
  const fs::path first = made.make("a-1", {}, {outer});
  const fs::path second = made.make("b-2", {.cpu_weight = 9}, {outer, inner});
  const fs::path third = made.make("c-3", {}, {outer, inner});
  EXPECT_EQ(first, tree_path_ / "group.1" / "a-1");
  EXPECT_EQ(second, tree_path_ / "group.1" / "group.2" / "b-2");
  EXPECT_EQ(third.parent_path(), second.parent_path());
  EXPECT_EQ(contents(tree_path_ / "group.1" / "memory.max"), "1000");
  EXPECT_EQ(contents(third.parent_path() / "pids.max"), "5");
  EXPECT_EQ(contents(second / "cpu.weight"), "9");
}

TEST_F(ControlGroups, AProcessWithoutLimitsHasNone) {
  ControlGroupTree made = tree({.obstacle = "no"});
  EXPECT_EQ(made.make("a-1", {}, {}), "");
  EXPECT_THAT(warnings_, IsEmpty());
}

TEST_F(ControlGroups, WhatCannotBeLimitedIsSaidOnce) {
  ControlGroupTree made = tree({.obstacle = "cgroups of version 2 are not mounted"});
  EXPECT_EQ(made.make("a-1", {.memory_max = 1}, {}), "");
  EXPECT_EQ(made.make("b-2", {}, {group({.pids_max = 1})}), "");
  EXPECT_THAT(warnings_, ElementsAre("limits of memory, processors and processes that a cgroup holds have no effect: "
                                     "cgroups of version 2 are not mounted"));
}

TEST_F(ControlGroups, AControllerThatIsNotThereIsNamedOnce) {
  put(tree_path_ / "cgroup.controllers", "cpu pids\n");
  ControlGroupTree made = tree({.directory = root_.string()});
  EXPECT_NE(made.make("a-1", {.memory_max = 1, .pids_max = 3}, {}), "");
  EXPECT_NE(made.make("b-2", {.memory_max = 1}, {}), "");
  EXPECT_THAT(warnings_, ElementsAre(HasSubstr("memory_max has no effect: the controller 'memory' is not in '")));
  EXPECT_EQ(contents(tree_path_ / "a-1" / "pids.max"), "3");
}

TEST(ControlGroupPlaces, AreInADelegatedCgroup) {
  const auto delegated = [](const std::string& path) { return path == "/c/user/scope"; };
  EXPECT_EQ(ControlGroupPlace::find({"/c/user/scope/launch-7", "/c"}, "7", false, delegated).directory,
            "/c/user/scope");
  EXPECT_EQ(ControlGroupPlace::find({"/c/user/scope/launch-7", "/c"}, "7", true, delegated).directory, "/c/user/scope");
}

TEST(ControlGroupPlaces, OfRootAreBelowTheRootOfAll) {
  const auto none = [](const std::string&) { return false; };
  EXPECT_EQ(ControlGroupPlace::find({"/c/session", "/c"}, "7", true, none).directory, "/c");
  EXPECT_THAT(ControlGroupPlace::find({"/c/session", "/c"}, "7", false, none).obstacle,
              HasSubstr("is not delegated to its user; start it by `systemd-run --user --scope -p Delegate=yes"));
  EXPECT_EQ(ControlGroupPlace::find({}, "7", true, none).obstacle, "cgroups of version 2 are not mounted");
}

TEST(OwnCgroups, AreFoundInTheMountsOfTheProcess) {
  const std::string mounts =
      "29 23 0:26 / /sys/fs/cgroup rw,nosuid shared:9 - cgroup2 cgroup2 rw\n24 1 0:1 / /proc rw - proc proc rw\n";
  EXPECT_EQ(own_cgroup("0::/user.slice/a.scope\n", mounts).path, "/sys/fs/cgroup/user.slice/a.scope");
  EXPECT_EQ(own_cgroup("4:memory:/x\n0::/\n", mounts).path, "/sys/fs/cgroup");
  EXPECT_EQ(own_cgroup("4:memory:/x\n", mounts).path, "");
  EXPECT_EQ(own_cgroup("0::/a\n", "24 1 0:1 / /proc rw - proc proc rw\n").path, "");
  EXPECT_EQ(own_cgroup("0::/docker/1/a\n", "9 2 0:26 /docker/1 /sys/fs/cgroup rw - cgroup2 cgroup2 rw\n").path,
            "/sys/fs/cgroup/a");
}

TEST_F(ControlGroups, TheirUseIsReadUpToTheTree) {
  const fs::path group = tree_path_ / "group.1";
  put(group / "memory.current", "700\n");
  put(group / "memory.max", "1000\n");
  put(group / "talker-1" / "memory.current", "600\n");
  put(group / "talker-1" / "memory.max", "max\n");
  put(group / "talker-1" / "memory.events", "low 0\nhigh 3\nmax 2\noom 1\noom_kill 1\n");
  put(group / "talker-1" / "cpu.max", "50000 100000\n");
  put(group / "talker-1" / "cpu.stat", "usage_usec 5\nthrottled_usec 1234\n");
  put(group / "talker-1" / "pids.events", "max 4\n");
  const std::vector<ControlGroupUse> uses = read_control_groups((group / "talker-1").string());
  ASSERT_THAT(uses, SizeIs(2));
  EXPECT_EQ(uses[0].name, "group.1");
  EXPECT_EQ(uses[0].memory, 700U);
  EXPECT_EQ(uses[0].memory_max, 1000U);
  EXPECT_EQ(uses[1].name, "talker-1");
  EXPECT_EQ(uses[1].memory_max, std::nullopt);
  EXPECT_EQ(uses[1].out_of_memory, 1U);
  EXPECT_EQ(uses[1].slowed, 3U);
  EXPECT_EQ(uses[1].refused, 4U);
  EXPECT_EQ(uses[1].cpu_quota, 0.5);
  EXPECT_EQ(uses[1].throttled, 1234U);
}

TEST(KernelMessages, NameTheProcessThatHadToEnd) {
  const std::string record = "3,1234,90000000,-;Out of memory: Killed process 42 (talker) total-vm:1kB\n";
  EXPECT_TRUE(tells_of_end(record, 42, 90s));
  EXPECT_FALSE(tells_of_end(record, 4, 90s));
  EXPECT_FALSE(tells_of_end(record, 42, 300s)) << "another one had the number before";
  EXPECT_TRUE(tells_of_end("3,1,5,-;Memory cgroup out of memory: Killed process 7 (a) total-vm:1kB\n", 7, 0s));
  for (const char* const nonsense : {"", ";", "3;Killed process 42 (a)", "3,1;,Killed process 42 (a)"}) {
    EXPECT_FALSE(tells_of_end(nonsense, 42, 0s)) << nonsense;
  }
  EXPECT_FALSE(ended_for_want_of_memory(1, 0s, "/no such file"));
}

}  // namespace
}  // namespace launch
