// SPDX-License-Identifier: Apache-2.0
#include "launcher/traced/tracetools_choice.hpp"

#include <gmock/gmock.h>

#include <filesystem>

namespace {

using launch::ProcessSpec;
using launch::TracetoolsChoice;
using launch::TracetoolsMode;
using testing::HasSubstr;
using tracing::TracetoolsFinding;
using Uses = TracetoolsFinding::Kind;

const std::string kPrefix = std::string(OTHER_ROS2) + "/jazzy";
const std::string kTalker = kPrefix + "/lib/demo/talker";
const std::string kStandIn = std::string(PREFIX) + "/lib/tracetools/stand_ins/8.1/libtracetools.so";

ProcessSpec process(std::vector<std::string> argv, const std::string& name = "talker") {
  ProcessSpec spec;
  spec.name = name;
  spec.argv = std::move(argv);
  spec.environment = {{"PATH", "/usr/bin:/bin"}, {"LD_LIBRARY_PATH", kPrefix + "/lib"}};
  return spec;
}

Uses used_by(const ProcessSpec& spec, TracetoolsMode mode = TracetoolsMode::kAuto) {
  return TracetoolsChoice(mode, PREFIX).look_at(spec).kind;
}

TEST(TracetoolsChoice, TheProgramMayBeAnywhereInTheCommand) {
  EXPECT_EQ(used_by(process({kTalker, "100"})), Uses::kStandIn);
  EXPECT_EQ(used_by(process({"env", "X=1", kTalker})), Uses::kStandIn);
  EXPECT_EQ(used_by(process({"env", "X=1", "/etc/passwd"})), Uses::kNone);
  EXPECT_EQ(used_by(process({"no_such_program", kTalker})), Uses::kNone);
  ProcessSpec shell = process({"cd /tmp && exec " + kTalker + " 100"});
  shell.shell = true;
  EXPECT_EQ(used_by(shell), Uses::kStandIn);
  ProcessSpec elsewhere = process({"./talker"});
  elsewhere.working_directory = kPrefix + "/lib/demo";
  EXPECT_EQ(used_by(elsewhere), Uses::kStandIn);
  ProcessSpec in_path = process({"talker"});
  in_path.environment.insert_or_assign("PATH", kPrefix + "/lib/demo");
  EXPECT_EQ(used_by(in_path), Uses::kStandIn);
}

TEST(TracetoolsChoice, WhatAUserPreloadsStays) {
  ProcessSpec spec = process({kTalker});
  spec.environment.insert_or_assign("LD_PRELOAD", "/opt/backends/usdt/libtracetools.so");
  EXPECT_EQ(used_by(spec), Uses::kNone);
  spec.environment.insert_or_assign("LD_PRELOAD", "/opt/libheap.so");
  TracetoolsChoice choice(TracetoolsMode::kAuto, PREFIX);
  TracetoolsChoice::preload(choice.look_at(spec), spec.environment);
  EXPECT_EQ(spec.environment.at("LD_PRELOAD"), "/opt/libheap.so:" + kStandIn);
  EXPECT_EQ(spec.environment.at("TRACETOOLS_STANDS_IN_FOR_VERSION"), "8.2.4");
}

TEST(TracetoolsChoice, TheirsIsForThoseThatHaveTheirs) {
  TracetoolsChoice choice(TracetoolsMode::kTheirs, PREFIX);
  ProcessSpec spec = process({kTalker});
  TracetoolsChoice::preload(choice.look_at(spec), spec.environment);
  EXPECT_FALSE(spec.environment.contains("LD_PRELOAD"));
  choice.look_at(process({"/bin/true"}, "tool"));
  const std::string told = choice.ineffective({}, {"max-overhead"});
  EXPECT_THAT(told, HasSubstr("these processes keep the tracetools of their ROS 2: talker (tracetools=\"theirs\"); "
                              "without effect on them: max-overhead, counts"));
  EXPECT_EQ(choice.ineffective({}, {"max-overhead"}), "") << "once";
  EXPECT_EQ(choice.refused(), std::nullopt);
  ASSERT_EQ(choice.uses().size(), 1U);
  EXPECT_FALSE(choice.uses()[0].is_own);
}

TEST(TracetoolsChoice, OwnRefusesWhatCannotHaveOurs) {
  TracetoolsChoice choice(TracetoolsMode::kOwn, PREFIX);
  choice.look_at(process({kTalker}));
  EXPECT_EQ(choice.refused(), std::nullopt);
  choice.look_at(process({std::string(OTHER_ROS2) + "/static_node"}, "arm"));
  EXPECT_EQ(choice.refused(), "tracetools=\"own\" cannot be had for arm: it is linked statically");
}

}  // namespace
