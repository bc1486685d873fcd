// SPDX-License-Identifier: Apache-2.0
#include "tracing/record/programs/tracetools_check.hpp"

#include <elf.h>
#include <gmock/gmock.h>
#include <sys/stat.h>

#include <filesystem>
#include <fstream>

#include "tests/support/command.hpp"
#include "tests/support/sandbox.hpp"

namespace {

namespace fs = std::filesystem;
using tracing::stand_in_for;
using tracing::TracetoolsCheck;
using tracing::TracetoolsFinding;
using tracing::version_of_package;
using Kind = TracetoolsFinding::Kind;

const std::string kFolder = OTHER_ROS2;

TracetoolsFinding check(const fs::path& prefix, const std::string& program = "talker") {
  TracetoolsCheck check(PREFIX);
  return check.check(prefix / "lib/demo" / program, {{"LD_LIBRARY_PATH", prefix / "lib"}});
}

TEST(TracetoolsCheck, EachVersionThatWasInADistributionHasAStandIn) {
  const auto of = [](int major, int minor) { return stand_in_for({.major = major, .minor = minor, .text = {}}); };
  EXPECT_EQ(of(4, 1), "4.0");   // Humble
  EXPECT_EQ(of(6, 3), "5.1");   // Iron
  EXPECT_EQ(of(8, 2), "8.1");   // Jazzy
  EXPECT_EQ(of(8, 6), "8.4");   // Kilted
  EXPECT_EQ(of(8, 10), "8.4");  // Lyrical
  EXPECT_EQ(of(3, 1), "");
  EXPECT_EQ(of(5, 0), "");
  EXPECT_EQ(of(8, 0), "");
  EXPECT_EQ(of(8, 11), "");
  EXPECT_EQ(of(9, 0), "");
}

TEST(TracetoolsCheck, TheVersionIsReadFromThePackage) {
  const auto read = [](const std::string& text) {
    const auto version = version_of_package(text);
    return version ? std::to_string(version->major) + " " + std::to_string(version->minor) + " " + version->text : "";
  };
  EXPECT_EQ(read("<package><version>4.1.1</version></package>"), "4 1 4.1.1");
  EXPECT_EQ(read("<package format=\"3\">\n<version compatibility=\"8.2.0\"> 8.10.2 </version>"), "8 10 8.10.2");
  EXPECT_EQ(read("<package></package>"), "");
  EXPECT_EQ(read("<version>eight</version>"), "");
  EXPECT_EQ(read("<version>8</version>"), "");
  EXPECT_EQ(read("<version>"), "");
  EXPECT_EQ(read(""), "");
}

TEST(TracetoolsCheck, OursStandsInForThatOfEachDistribution) {
  for (const auto& [name, version, stand_in] :
       {std::tuple("humble", "4.1.1", "4.0"), std::tuple("iron", "6.3.2", "5.1"), std::tuple("jazzy", "8.2.4", "8.1"),
        std::tuple("kilted", "8.6.0", "8.4"), std::tuple("newest", "8.10.1", "8.4")}) {
    const TracetoolsFinding finding = check(kFolder + "/" + name);
    EXPECT_EQ(finding.kind, Kind::kStandIn) << name << ": " << finding.reason;
    EXPECT_EQ(finding.theirs, kFolder + "/" + name + "/lib/libtracetools.so");
    EXPECT_EQ(finding.version, version);
    EXPECT_EQ(finding.library, std::string(PREFIX) + "/lib/tracetools/stand_ins/" + stand_in + "/libtracetools.so");
  }
}

TEST(TracetoolsCheck, OurProgramsAndOtherProgramsAreLeftAlone) {
  TracetoolsCheck check(PREFIX);
  EXPECT_EQ(check.check(FIRE_ALL_EVENTS, {{"LD_LIBRARY_PATH", kFolder + "/jazzy/lib"}}).kind, Kind::kOurs);
  EXPECT_EQ(check.check("/bin/true", {{"LD_LIBRARY_PATH", kFolder + "/jazzy/lib"}}).kind, Kind::kNone);
  EXPECT_EQ(check.check("/etc/passwd", {}).kind, Kind::kNone);
  EXPECT_EQ(check.check("/nowhere", {}).kind, Kind::kNone);
}

TEST(TracetoolsCheck, AScriptIsANodeIfItIsOfPythonAndInAPackage) {
  const fs::path prefix = kFolder + "/jazzy";
  EXPECT_EQ(check(prefix, "python_talker").kind, Kind::kStandIn);
  test_support::Sandbox sandbox;
  const std::string tool = sandbox.directory() / "tool.py";
  fs::copy(prefix / "lib/demo/python_talker", tool);
  TracetoolsCheck check(PREFIX);
  EXPECT_EQ(check.check(tool, {{"LD_LIBRARY_PATH", prefix / "lib"}}).kind, Kind::kNone);
}

// A prefix that may be changed.
class ChangedPrefix : public testing::Test {
 protected:
  void SetUp() override {
    fs::copy(kFolder + "/jazzy", prefix_, fs::copy_options::recursive);
    fs::permissions(program_, fs::perms::owner_all);
  }

  void set_version(const std::string& version) const {
    test_support::write_file(prefix_ / "share/tracetools/package.xml",
                             "<package><version>" + version + "</version></package>");
  }

  std::string reason() const {
    const TracetoolsFinding finding = check(prefix_);
    EXPECT_EQ(finding.kind, Kind::kTheirs);
    EXPECT_EQ(finding.library, "");
    return finding.reason;
  }

  test_support::Sandbox sandbox_;
  fs::path prefix_ = sandbox_.directory() / "other";
  fs::path program_ = prefix_ / "lib/demo/talker";
};

TEST_F(ChangedPrefix, VersionsThatAreNotKnownStay) {
  set_version("3.1.0");
  EXPECT_EQ(reason(), "version 3.1.0 of tracetools is older than 4.0");
  set_version("9.0.0");
  EXPECT_EQ(reason(), "version 9.0.0 of tracetools is newer than 8.10");
  set_version("8.0.1");
  EXPECT_EQ(reason(), "version 8.0.1 of tracetools was in no ROS 2");
  fs::remove(prefix_ / "share/tracetools/package.xml");
  EXPECT_EQ(reason(), "the version of " + (prefix_ / "lib/libtracetools.so").string() +
                          " is unknown: share/tracetools/package.xml is missing");
}

TEST_F(ChangedPrefix, ALibraryWithOtherParametersThanItsVersionSaysStays) {
  set_version("6.3.2");
  EXPECT_EQ(reason(), "rmw_publish of its tracetools has not the parameters of version 6.3.2");
}

TEST_F(ChangedPrefix, AnotherProcessorStays) {
  for (const char* file : {"lib/demo/talker", "lib/librclcpp.so", "lib/libtracetools.so"}) {
    std::fstream stream(prefix_ / file, std::ios::in | std::ios::out | std::ios::binary);
    constexpr std::uint16_t kMachine = EM_RISCV;
    stream.seekp(offsetof(Elf64_Ehdr, e_machine));
    stream.write(reinterpret_cast<const char*>(&kMachine), sizeof kMachine);
  }
  EXPECT_EQ(reason(), "it is built for another processor");
}

TEST_F(ChangedPrefix, AProgramWithMoreRightsThanItsUserStays) {
  ASSERT_EQ(::chmod(program_.c_str(), 04755), 0);
  EXPECT_EQ(reason(), "it has rights that its user does not have, so nothing is preloaded");
}

TEST_F(ChangedPrefix, ALibraryWithAnUnknownFunctionStays) {
  EXPECT_EQ(check(kFolder + "/forked").reason, "its tracetools has ros_trace_dds_write, which ours lacks");
  TracetoolsCheck check(PREFIX);
  EXPECT_EQ(check.check(kFolder + "/static_node", {}).reason, "it is linked statically");
}

TEST_F(ChangedPrefix, WithoutOurLibrariesTheirsStays) {
  TracetoolsCheck check("/nowhere");
  EXPECT_EQ(check.check(program_, {{"LD_LIBRARY_PATH", prefix_ / "lib"}}).reason,
            "/nowhere/lib/tracetools/stand_ins/8.1/libtracetools.so is not installed");
}

}  // namespace
