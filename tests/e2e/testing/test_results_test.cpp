// SPDX-License-Identifier: Apache-2.0
// `launch test`: its results for other programs, in files, through an engine of theirs, and in CTest.
#include <gmock/gmock.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "tests/e2e/testing/launch_test_fixture.hpp"

namespace {

using namespace test_support;
using testing::AnyOf;
using testing::HasSubstr;

namespace fs = std::filesystem;

class TestResults : public LaunchTestFixture {};

// A report for other programs shows the last output of such a test, whatever bytes it has.
TEST_F(TestResults, OutputThatIsNoTextLeavesTheResultsReadable) {
  const std::string bytes = sandbox_.directory() / "bytes";
  write_file(bytes, "before \xff\xfe\x01 after\n");
  const std::string file =
      write("a.launch.xml", R"xml(
  <test name="kills it"><executable name="step" shell="true" output="screen" cmd="cat )xml" +
                                bytes + R"xml(; kill -9 $PPID; sleep 1000"/><exit process="step"/></test>
  <test name="fails"><executable name="step" cmd="cat )xml" +
                                bytes + R"xml("/><output process="step" text="none"/></test>)xml");
  const std::string junit = sandbox_.directory() / "junit.xml";
  const std::string json = sandbox_.directory() / "result.json";
  EXPECT_EQ(run({file, "--junit", junit, "--json", json}).exit_code, 1);
  const CommandResult read =
      run_command({.argv = {"python3", "-c",
                            "import json, sys, xml.etree.ElementTree as tree\n"
                            "print(len(json.load(open(sys.argv[2]))['tests']))\n"
                            "print(sum('before \ufffd\ufffd after' in (failure.text or '') for failure in "
                            "tree.parse(sys.argv[1]).iter('failure')))\n",
                            junit, json}},
                  std::chrono::seconds(20));
  // What the test had not read when it was killed is lost, on a busy machine.
  EXPECT_THAT(read.out, AnyOf("2\n2\n", "2\n1\n")) << read.err;
}

TEST_F(TestResults, WritesResultsForOtherPrograms) {
  write("tests/a.launch.xml", R"xml(
  <executable cmd="echo &lt;hello&gt;" name="greeter"/>
  <test name="good"><output text="hello"/></test>
  <test name="bad &amp; ugly"><output text="&lt;bye&gt;"/></test>)xml");
  write("tests/no_test.launch.xml", R"xml(<executable cmd="true"/>)xml");
  const fs::path out = sandbox_.directory() / "out";
  const CommandResult result = run({(sandbox_.directory() / "tests").string(), "--junit", out / "j.xml", "--tap",
                                    out / "t.tap", "--json", out / "r.json", "--directory", out / "files", "--keep"});
  EXPECT_EQ(result.exit_code, 1);
  const std::string junit = read_file(out / "j.xml");
  EXPECT_THAT(junit, HasSubstr("<testsuites name=\"launch test\" tests=\"2\" failures=\"1\" errors=\"0\""));
  EXPECT_THAT(junit, HasSubstr("<testcase name=\"bad &amp; ugly\""));
  EXPECT_THAT(junit, HasSubstr("<failure message=\"there was not a line with '&lt;bye>' before the system ended\">"));
  EXPECT_EQ(run_command({"xmllint", "--noout", out / "j.xml"}).exit_code, 0);
  const std::string tap = read_file(out / "t.tap");
  EXPECT_THAT(tap, HasSubstr("TAP version 13\n1..2\nok 1 - "));
  EXPECT_THAT(tap, HasSubstr("\nnot ok 2 - "));
  const auto json = nlohmann::json::parse(read_file(out / "r.json"));
  EXPECT_EQ(json["passed"], 1);
  EXPECT_EQ(json["tests"][1]["outcome"], "failed");
  EXPECT_EQ(json["tests"][1]["failures"][0]["line"], 5);
  EXPECT_TRUE(fs::exists(out / "files" / "0001-good" / "output.txt"));
}

TEST_F(TestResults, WhatCanNotBeWrittenIsAnError) {
  const std::string file = write("a.launch.xml", R"xml(
  <executable cmd="echo hello" name="greeter"/>
  <test name="good"><output text="hello"/></test>)xml");
  const CommandResult nowhere = run({file, "--directory", "/proc/files"});
  EXPECT_EQ(nowhere.exit_code, 1);
  EXPECT_EQ(nowhere.err, "launch test: error: cannot make '/proc/files': No such file or directory\n");
  const CommandResult full = run_command({"sh", "-c", "\"$0\" test \"$1\" >/dev/full", LAUNCH_PROGRAM, file});
  EXPECT_EQ(full.exit_code, 1);
  EXPECT_EQ(full.err, "launch test: error: cannot write the output\n");
}

TEST_F(TestResults, AnEngineGetsEachTestAndGivesItsResult) {
  const std::string file = write("a.launch.xml", R"xml(
  <arg name="code"/>
  <executable name="say" shell="true" cmd="echo of $BY_ENGINE; exit $(var code)"/>
  <test name="good 'one' $ &amp; all"><exit process="say" code="3"/><output text="of engine"/></test>
  <test name="bad"><exit process="say" code="4"/></test>)xml");
  // The command line goes through a shell, as it does with ssh.
  const fs::path engine = sandbox_.directory() / "engine";
  write_file(engine, "#!/bin/sh\necho something else\nexport BY_ENGINE=engine\neval \"$@\"\n");
  fs::permissions(engine, fs::perms::owner_all);
  CommandResult result = run({file, "code:=3", "--engine", engine});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(plain(result.out), HasSubstr("PASS  a.launch.xml: good 'one' $ & all  T s\n"));
  EXPECT_THAT(plain(result.out),
              HasSubstr("FAIL  a.launch.xml: bad  T s\na.launch.xml:6:21: error: 'say' has exited with code 3\n"));
  result = run({file, "code:=3", "-n", "bad", "--engine", "echo no"});
  EXPECT_THAT(plain(result.out),
              HasSubstr("a.launch.xml:6:4: error: the engine has ended with code 0, without a result\n"));
  EXPECT_THAT(result.out, HasSubstr("      |    ^~~~\nno "));
}

TEST_F(TestResults, CTestRunsLaunchFilesOfAProject) {
  write("project/test/good.launch.xml", R"xml(
  <arg name="word"/>
  <executable name="say" cmd="printenv GREETING"/>
  <test name="says"><output process="say" text="$(var word)"/></test>)xml");
  write("project/test/bad.launch.xml", R"xml(<executable name="say" cmd="true"/>
  <test name="fails"><exit process="say" code="1"/></test>)xml");
  write_file(sandbox_.directory() / "project/CMakeLists.txt", R"cmake(cmake_minimum_required(VERSION 3.16)
project(mine LANGUAGES NONE)
find_package(launch_test REQUIRED)
find_package(launch_testing_ament_cmake REQUIRED)
enable_testing()
add_launch_test(test/good.launch.xml ARGS word:=hello ENV GREETING=hello TIMEOUT 90 LABELS system)
add_launch_test(test/bad.launch.xml TARGET bad)
# As packages of ROS 2 do it: the file is made for each configuration, when the build files are written.
file(GENERATE OUTPUT "${CMAKE_CURRENT_BINARY_DIR}/made_$<CONFIG>.launch.xml" CONTENT [[<launch>
  <executable name="say" cmd="printenv MADE_PATH"/>
  <test name="appends"><output process="say" text="/before:/one:/two"/></test>
</launch>]])
add_launch_test("${CMAKE_CURRENT_BINARY_DIR}/made_$<CONFIG>.launch.xml" TARGET made ENV MADE_PATH=/before
  APPEND_ENV MADE_PATH="/one" MADE_PATH=/two PYTHON_EXECUTABLE /usr/bin/python3)
add_launch_test(test/bad.launch.xml TARGET left_out SKIP_TEST)
)cmake");
  const fs::path build = sandbox_.directory() / "build";
  const CommandResult configured = run_command({.argv = {CMAKE, "-S", sandbox_.directory() / "project", "-B", build,
                                                         "-DCMAKE_PREFIX_PATH=" BUILD_DIRECTORY "/prefix"}},
                                               std::chrono::seconds(100));
  ASSERT_EQ(configured.exit_code, 0) << configured.out << configured.err;
  const std::string ctest = fs::path(CMAKE).parent_path() / "ctest";
  const CommandResult good =
      run_command({.argv = {ctest, "--test-dir", build, "-L", "^system$", "-V"}}, std::chrono::seconds(100));
  EXPECT_EQ(good.exit_code, 0) << good.out << good.err;
  EXPECT_THAT(good.out, HasSubstr("test_good.launch.xml"));
  EXPECT_THAT(read_file(build / "test_results/mine/test_good.launch.xml.xunit.xml"),
              HasSubstr("<testcase name=\"says\""));
  const CommandResult bad =
      run_command({.argv = {ctest, "--test-dir", build, "-R", "^bad$"}}, std::chrono::seconds(100));
  EXPECT_EQ(bad.exit_code, 8) << bad.out << bad.err;
  EXPECT_THAT(read_file(build / "test_results/mine/bad.xunit.xml"), HasSubstr("'say' has exited with code 0"));
  const CommandResult made =
      run_command({.argv = {ctest, "--test-dir", build, "-R", "^(made|left_out)$", "--output-on-failure"}},
                  std::chrono::seconds(100));
  EXPECT_EQ(made.exit_code, 0) << made.out << made.err;
  EXPECT_THAT(made.out, HasSubstr("left_out (Disabled)"));
}

}  // namespace
