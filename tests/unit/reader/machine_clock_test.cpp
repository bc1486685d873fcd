// SPDX-License-Identifier: Apache-2.0
// Traces of other machines, whose clocks a launch has compared with its own.
#include "tracing/decode/reader/direct/machine_clock.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "tests/support/sandbox.hpp"
#include "tracing/decode/ctf/trace_class.hpp"
#include "tracing/decode/reader/recording.hpp"

namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::IsEmpty;
using tracing::put_on_clock_of_launch;
using tracing::Recording;

constexpr std::int64_t kSecond = 1'000'000'000;
constexpr std::int64_t kEpoch = 1'700'000'000 * kSecond;  // when the clock of the launch shows 0

const Recording kArm{.host = "arm", .machine = "boot-2", .session = "walk-arm"};
const Recording kHere{.host = "desk", .machine = "boot-1", .session = "walk"};

tracing::ctf::TraceClass trace_with_epoch(std::int64_t epoch) {
  tracing::ctf::TraceClass trace;
  trace.clocks["monotonic"] = {
      .name = "monotonic", .uuid = "boot", .offset_s = epoch / kSecond, .offset = epoch % kSecond};
  return trace;
}

std::int64_t time_of(const tracing::ctf::TraceClass& trace, std::int64_t cycles) {
  return trace.clocks.at("monotonic").nanoseconds(static_cast<std::uint64_t>(cycles));
}

class MachineClock : public testing::Test {
 protected:
  MachineClock() { fs::create_directories(trace); }
  // 1000 s after the boot of the machine of the launch its clock was compared.
  void measured(std::int64_t offset, double drift, std::int64_t uncertainty, const std::string& boot = "boot-1") {
    say(fmt::format(R"({{"machine": "arm", "offset_ns": 0, "uncertainty_ns": {}, "drift": {:.12f},
        "monotonic": {{"at_ns": {}, "offset_ns": {}, "epoch_ns": {}, "boot": "{}"}}}})",
                    uncertainty, drift, 1000 * kSecond, offset, kEpoch, boot));
  }
  void say(const std::string& text) const { std::ofstream(folder / "clock.json") << text; }
  std::vector<std::string> notes_on(tracing::ctf::TraceClass& declarations) const {
    std::vector<std::string> notes;
    put_on_clock_of_launch({{kArm, declarations, trace}}, notes);
    return notes;
  }

  test_support::Sandbox sandbox;
  fs::path folder = sandbox.directory() / "walk/arm";
  fs::path trace = folder / "ust/uid/0/64-bit";
};

// The machine has booted 700 s before, and its wall clock is 3.7 s ahead.
TEST_F(MachineClock, TheTimesAreMoved) {
  measured(700 * kSecond, 0, 50'000);
  tracing::ctf::TraceClass arm = trace_with_epoch(kEpoch - 700 * kSecond + 3'700'000'000);
  EXPECT_THAT(notes_on(arm),
              ElementsAre("the clock of arm was 3.700000 s ahead of that of the launch, as measured through the "
                          "connection within 0.000050 s: its times were moved"));
  EXPECT_EQ(time_of(arm, 1700 * kSecond), kEpoch + 1000 * kSecond);
  EXPECT_EQ(time_of(arm, 1712 * kSecond + 5), kEpoch + 1012 * kSecond + 5);
}

TEST_F(MachineClock, ADriftIsTakenOut) {
  const double drift = 50e-6;
  measured(-3 * kSecond, drift, 50'000);
  tracing::ctf::TraceClass arm = trace_with_epoch(kEpoch + 3 * kSecond - 3'700'000'000);
  EXPECT_THAT(notes_on(arm),
              ElementsAre("the clock of arm was 3.700000 s behind that of the launch and drifted by +50.00 ppm, as "
                          "measured through the connection within 0.000050 s: its times were moved"));
  for (const std::int64_t later : {-500 * kSecond, -kSecond, std::int64_t{0}, kSecond, 3600 * kSecond}) {
    const std::int64_t here = 1000 * kSecond + later;
    const std::int64_t there = here - 3 * kSecond + std::llround(drift * static_cast<double>(later));
    EXPECT_NEAR(static_cast<double>(time_of(arm, there) - kEpoch - here), 0, 5) << later;
  }
}

TEST_F(MachineClock, WhatTheMeasurementCannotTellIsLeftAlone) {
  measured(700 * kSecond, 0, 50'000);
  tracing::ctf::TraceClass arm = trace_with_epoch(kEpoch - 700 * kSecond + 49'000);
  EXPECT_THAT(notes_on(arm), IsEmpty());
  EXPECT_EQ(time_of(arm, 0), kEpoch - 700 * kSecond + 49'000);
}

// LTTng has measured for the trace of this machine 30 us more than the launch has.
TEST_F(MachineClock, TheTraceOfTheMachineOfTheLaunchIsTheMeasure) {
  measured(700 * kSecond, 0, 50'000);
  tracing::ctf::TraceClass arm = trace_with_epoch(kEpoch - 700 * kSecond + 3'700'000'000);
  tracing::ctf::TraceClass here = trace_with_epoch(kEpoch + 30'000);
  tracing::ctf::TraceClass elsewhere = trace_with_epoch(kEpoch + 90'000'000);
  std::vector<std::string> notes;
  put_on_clock_of_launch({{kHere, elsewhere, sandbox.directory() / "run/local/ust/uid/0/64-bit"},
                          {kArm, arm, trace},
                          {kHere, here, sandbox.directory() / "walk/local/ust/uid/0/64-bit"}},
                         notes);
  EXPECT_EQ(notes.size(), 1U);
  EXPECT_EQ(time_of(arm, 1700 * kSecond), time_of(here, 1000 * kSecond));
  EXPECT_EQ(time_of(here, 0), kEpoch + 30'000);
}

TEST_F(MachineClock, WhatIsNotOfThisTraceIsNotReadAndNonsenseHasNoEffect) {
  const std::int64_t epoch = kEpoch + 3600 * kSecond;
  measured(700 * kSecond, 0, 50'000);
  std::ofstream(folder / "ust/verdict.json") << "{}";
  tracing::ctf::TraceClass below_a_verdict = trace_with_epoch(epoch);
  EXPECT_THAT(notes_on(below_a_verdict), IsEmpty());
  fs::remove(folder / "ust/verdict.json");
  for (const std::string text :
       {"", "{}", "[]", "{", R"({"monotonic": 1, "drift": 0, "uncertainty_ns": 1})",
        R"({"monotonic": {"at_ns": 1, "offset_ns": 1, "epoch_ns": 1}, "drift": "x", "uncertainty_ns": 1})",
        R"({"monotonic": {"at_ns": 1, "offset_ns": 1, "epoch_ns": 1}, "drift": 0.5, "uncertainty_ns": 1})",
        R"({"monotonic": {"at_ns": 1, "offset_ns": 1, "epoch_ns": 1}, "drift": 0, "uncertainty_ns": -1})",
        R"({"monotonic": {"at_ns": 1, "offset_ns": -2, "epoch_ns": 1}, "drift": 0, "uncertainty_ns": 1})",
        R"({"monotonic": {"at_ns": 9223372036854775807, "offset_ns": 1, "epoch_ns": 1}, "drift": 0,
            "uncertainty_ns": 1})",
        R"({"monotonic": {"at_ns": 1, "offset_ns": 1.5, "epoch_ns": 1}, "drift": 0, "uncertainty_ns": 1})"}) {
    say(text);
    tracing::ctf::TraceClass arm = trace_with_epoch(epoch);
    EXPECT_THAT(notes_on(arm), IsEmpty()) << text;
    EXPECT_EQ(time_of(arm, 0), epoch) << text;
  }
  measured(700 * kSecond, 0, 50'000);
  tracing::ctf::TraceClass other_clock = trace_with_epoch(epoch);
  other_clock.clocks.at("monotonic").name = "cycles";
  EXPECT_THAT(notes_on(other_clock), IsEmpty());
}

}  // namespace
