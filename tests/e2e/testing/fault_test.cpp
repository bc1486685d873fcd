// SPDX-License-Identifier: Apache-2.0
// Faults in the tests of launch files: real processes are killed, stopped, slowed and limited.
#include <gmock/gmock.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "tests/e2e/testing/launch_test_fixture.hpp"

namespace {

using namespace test_support;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

namespace fs = std::filesystem;

// Counts its lines, and one in `step` seconds.
constexpr const char* kCounter = R"sh(i=0
while :; do
  i=$((i + 1))
  echo item $i
  sleep $1
done
)sh";

class FaultTest : public LaunchTestFixture {
 protected:
  FaultTest() { write_file(sandbox_.directory() / "counter.sh", kCounter); }

  std::string write(const std::string& actions) { return LaunchTestFixture::write("a.launch.xml", actions); }
};

TEST_F(FaultTest, AProcessThatItKillsHasNotFailedAndRespawns) {
  const std::string file = write(R"xml(
  <executable name="p" cmd="sh $(dirname)/counter.sh 0.01" respawn="true" respawn_delay="0.01"/>
  <executable name="q" cmd="cat"/>
  <test name="t">
    <fault process="p" do="kill"><depends_on process="p" condition="output" pattern="item" occurrence="3"/></fault>
    <fault process="q" do="kill" signal="SIGSEGV"/>
    <in_order process="p"><line text="item 3"/><line pattern="item 1$"/></in_order>
  </test>)xml");
  const CommandResult result = run({file});
  EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
  EXPECT_EQ(plain(result.out), "PASS  a.launch.xml: t  T s  (2 of 2 faults)\n\n1 test: 1 passed, in T s\n");
}

TEST_F(FaultTest, WhatTheKillBringsDownHasFailed) {
  write_file(sandbox_.directory() / "p.sh", "trap 'exit 3' TERM; echo ready; while :; do :; done\n");
  const std::string file = write(R"xml(
  <executable name="p" cmd="sh $(dirname)/p.sh"/>
  <test name="t">
    <fault process="p" do="kill" signal="SIGTERM"><depends_on process="p" condition="output" pattern="ready"/></fault>
    <output text="never"/>
  </test>)xml");
  const CommandResult result = run({file});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_EQ(plain(result.out), R"(FAIL  a.launch.xml: t  T s  (1 of 1 fault)
a.launch.xml:3:4: error: p-1 has exited with code 3
    3 |   <executable name="p" cmd="sh $(dirname)/p.sh"/>
      |    ^~~~~~~~~~
      = help: if that is right: <exit process="p" code="3"/>
      = last lines of p-1:
          ready
      = not judged: 1 expectation
      = seed 1: 1 of 1 fault applied
          1  a.launch.xml:5:6: kill of 'p' by SIGTERM at T s
      = again: launch test a.launch.xml --seed 1
      = files: DIR/0001-t

1 test: 0 passed, 1 failed, in T s
)");
}

TEST_F(FaultTest, AKillThatEndsTheSystemIsExpectedAndSoIsTheEndOfWhatHasIgnoredIt) {
  write_file(sandbox_.directory() / "deaf.sh", "trap '' TERM; echo ready; while :; do sleep 0.01; done\n");
  const std::string file = write(R"xml(
  <executable name="leader" cmd="cat" on_exit="shutdown"/>
  <executable name="deaf" cmd="sh $(dirname)/deaf.sh"/>
  <test name="t">
    <fault process="deaf" do="kill" signal="SIGTERM">
      <depends_on process="deaf" condition="output" pattern="ready"/>
    </fault>
    <fault process="leader" do="kill" signal="SIGSEGV" at="0.1">
      <depends_on process="deaf" condition="output" pattern="ready"/>
    </fault>
    <output text="ready"/>
  </test>)xml");
  const CommandResult result = run({file});
  EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
  EXPECT_THAT(result.out, HasSubstr("(2 of 2 faults)"));
}

// Says when it stood still, and what its limit of descriptors is whenever that changes.
constexpr const char* kWitness = R"py(import resource
import time

last = time.monotonic()
limit = None
print('ready', flush=True)
while True:
    time.sleep(0.002)
    now = time.monotonic()
    if now - last > 0.05:
        print(f'stood still for {now - last:.2f} s', flush=True)
    last = now
    found = resource.getrlimit(resource.RLIMIT_NOFILE)[0], resource.getrlimit(resource.RLIMIT_AS)[0]
    if found != limit:
        limit = found
        print(f'limits {limit[0]} {limit[1]}', flush=True)
)py";

TEST_F(FaultTest, StopsSlowsAndLimits) {
  write_file(sandbox_.directory() / "witness.py", kWitness);
  const std::string file = write(R"xml(
  <executable name="stopped" cmd="python3 $(dirname)/witness.py"/>
  <executable name="slow" cmd="python3 $(dirname)/witness.py"/>
  <executable name="limited" cmd="python3 $(dirname)/witness.py"/>
  <test name="t">
    <fault process="stopped" do="stop" for="0.3">
      <depends_on process="stopped" condition="output" pattern="limits"/>
    </fault>
    <fault process="slow" do="slow" to="10%" for="0.5">
      <depends_on process="slow" condition="output" pattern="limits"/>
    </fault>
    <fault process="limited" do="limit" memory="1G" files="50" for="0.1">
      <depends_on process="limited" condition="output" pattern="limits"/>
    </fault>
    <output process="stopped" pattern="stood still for (0\\.[3-9]|[1-9])"/>
    <output process="slow" pattern="stood still for " min="3"/>
    <in_order process="limited">
      <line pattern="limits [0-9]+ -1"/>
      <line text="limits 50 1073741824"/>
      <line pattern="limits [0-9]+ -1"/>
    </in_order>
  </test>)xml");
  const CommandResult result = run({file, "--keep", "--directory", sandbox_.directory() / "out"});
  EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
  const std::string output = read_file(sandbox_.directory() / "out/0001-t/output.txt");
  EXPECT_THAT(output,
              AllOf(HasSubstr("fault 1: stop of 'stopped' for 0.3 s"), HasSubstr("fault 2: slow of 'slow' to 10% for"),
                    HasSubstr("fault 3: limit of 'limited' to 1073741824 bytes and 50 files for 0.1 s")));
}

TEST_F(FaultTest, AFaultThatCouldNotBeAppliedFailsTheTestUnlessItIsDrawn) {
  const std::string file = write(R"xml(
  <executable name="p" cmd="true"/>
  <executable name="q" cmd="cat"/>
  <test name="certain">
    <fault process="p" do="kill" at="0.3"/>
    <exit process="q" when="shutdown" code="SIGINT"/>
    <exit process="p"/>
  </test>
  <test name="drawn">
    <fault process="p" do="kill" at="0.3..0.4"/>
    <exit process="q" when="shutdown" code="SIGINT"/>
    <exit process="p"/>
  </test>)xml");
  const CommandResult result = run({file, "-j", "1"});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_EQ(plain(result.out), R"(FAIL  a.launch.xml: certain  T s  (0 of 1 fault)
a.launch.xml:6:6: error: the kill of 'p' was not applied: 'p' did not run
    6 |     <fault process="p" do="kill" at="0.3"/>
      |      ^~~~~
      = seed 1: 0 of 1 fault applied
          1  a.launch.xml:6:6: kill of 'p': not applied: 'p' did not run
      = again: launch test a.launch.xml --name certain --seed 1
      = files: DIR/0001-certain
PASS  a.launch.xml: drawn  T s  (0 of 1 fault)

2 tests: 1 passed, 1 failed, in T s
FAIL  a.launch.xml: certain
)");
}

TEST_F(FaultTest, NamesThatNoProcessHasAreErrorsBeforeAnythingStarts) {
  const std::string file = write(R"xml(
  <executable name="worker" shell="true" cmd="touch $(dirname)/started"/>
  <test name="t">
    <fault process="wroker" do="kill"/>
    <exit process="worker"/>
  </test>)xml");
  const CommandResult result = run({file});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_EQ(result.out, "");
  EXPECT_EQ(plain(result.err), R"(a.launch.xml:5:21: error: no process is named 'wroker'
    5 |     <fault process="wroker" do="kill"/>
      |                     ^~~~~~
      = help: did you mean 'worker'?
)");
  EXPECT_FALSE(fs::exists(sandbox_.directory() / "started"));
}

// Of 100 seeds the one that draws four faults at once has a fault that the system does not survive.
TEST_F(FaultTest, OfManySeedsOneFailsAndIsShrunk) {
  const std::string file = write(R"xml(
  <executable name="a" cmd="cat"/>
  <executable name="b" cmd="cat"/>
  <executable name="step" cmd="true"/>
  <test name="survives">
    <fault process="a" do="stop" for="0.001"/>
    <fault process="a" do="stop" for="0.002" at="0.001..0.003"/>
    <fault name="crash" process="b" do="kill" probability="0.01"/>
    <fault process="a" do="slow" to="50%" for="0.001..0.002"/>
    <exit process="step"/>
    <exit process="b" when="shutdown" code="SIGINT"/>
  </test>)xml");
  const std::string json = sandbox_.directory() / "result.json";
  const CommandResult result = run({file, "--seeds", "100", "--shrink", "--json", json});
  EXPECT_EQ(result.exit_code, 1);
  const auto results = nlohmann::json::parse(read_file(json));
  EXPECT_EQ(results["tests"].size(), 100U);
  EXPECT_EQ(results["failed"], 1) << result.out;
  for (const auto& test : results["tests"]) {
    EXPECT_EQ(test.contains("shrunk"), test["outcome"] == "failed");
    if (test.contains("shrunk")) {
      EXPECT_EQ(test["shrunk"]["of"], 4);
      ASSERT_EQ(test["shrunk"]["faults"].size(), 1U) << test.dump(2);
      EXPECT_EQ(test["shrunk"]["faults"][0]["what"], "kill of 'b'");
      const std::string seed = std::to_string(test["seed"].get<int>());
      EXPECT_THAT(plain(result.out), HasSubstr("SHRUNK  a.launch.xml: survives [seed " + seed + R"(]
      = shrunk to 1 of 4 faults in 4 runs:
          3  a.launch.xml:9:6: kill of 'b' at T s
      = again: launch test a.launch.xml --seed )" +
                                               seed + " --faults 3\n"));
      const CommandResult again = run({file, "--seed", seed, "--faults", "3"});
      EXPECT_EQ(again.exit_code, 1) << again.out;
      const CommandResult without = run({file, "--seed", seed, "--faults", "1,2,4"});
      EXPECT_EQ(without.exit_code, 0) << without.out;
    }
  }
}

TEST_F(FaultTest, TheSameSeedGivesTheSameFaultsInEachReport) {
  const std::string file = write(R"xml(
  <executable name="p" cmd="cat"/>
  <executable name="step" shell="true" cmd="echo $LAUNCH_TEST_SEED"/>
  <test name="t">
    <fault process="p" do="stop" for="0.001..0.02" at="0..0.02"/>
    <fault process="p" do="stop" for="0.001..0.02" probability="0.5"/>
    <exit process="step"/>
    <output process="step" pattern="^[78]$"/>
  </test>)xml");
  const auto faults = [&](const std::string& seed) {
    const std::string json = sandbox_.directory() / "result.json";
    run({file, "--seed", seed, "--json", json, "--junit", sandbox_.directory() / "result.xml", "--tap",
         sandbox_.directory() / "result.tap"});
    std::vector<std::string> texts;
    const auto results = nlohmann::json::parse(read_file(json));
    for (const auto& fault : results["tests"][0]["faults"]) {
      texts.push_back(fault["what"].get<std::string>() + (fault["left_out"].get<bool>() ? " not" : ""));
    }
    return texts;
  };
  EXPECT_NE(faults("8"), faults("7"));
  EXPECT_EQ(faults("7"), faults("7"));
  const std::string junit = read_file(sandbox_.directory() / "result.xml");
  EXPECT_THAT(junit, AllOf(HasSubstr("<property name=\"seed\" value=\"7\"/>"),
                           HasSubstr("<property name=\"fault 1\" value=\""), HasSubstr("stop of 'p' for 0.0")));
  EXPECT_THAT(read_file(sandbox_.directory() / "result.tap"), AllOf(HasSubstr("# seed 7\n"), HasSubstr("# fault 1: ")));
}

}  // namespace
