// SPDX-License-Identifier: Apache-2.0
// <fault do="fill_disk">: which disk it asks for, and its errors.
#include <gmock/gmock.h>

#include <filesystem>

#include "fault_plan.hpp"

namespace launch {
namespace {

using test_support::plan_faults;
using test_support::PlannedFaults;
using testing::ElementsAre;

const DiskFault& disk(const FaultRequest& fault) {
  return std::get<DiskFault>(fault.what);
}

TEST(DiskFault, SaysWhichDiskIsFull) {
  const PlannedFaults planned = plan_faults(R"xml(
    <fault do="fill_disk"/>
    <fault do="fill_disk" path="/data/../maps" for="2"/>
    <fault do="fill_disk" path="$(env PATH)" free="1M" at="1..2" probability="0.5"/>
    <fault do="fill_disk" path="bags"/>)xml");
  ASSERT_EQ(planned.error, "");
  const std::string bags = std::filesystem::current_path() / "bags";
  std::vector<std::string> texts;
  for (const FaultRequest& fault : planned.faults()) {
    texts.push_back(describe(fault));
  }
  EXPECT_THAT(texts, ElementsAre("full disk of the logs", "full disk at '/maps' for 2 s",
                                 "full disk at '/usr/bin:/bin' but for 1048576 bytes", "full disk at '" + bags + "'"));
  EXPECT_EQ(disk(planned.faults().at(0)).directory, "");
  EXPECT_EQ(disk(planned.faults().at(1)).directory, "/maps");
  EXPECT_TRUE(planned.faults().at(2).is_random);
  EXPECT_FALSE(planned.faults().at(3).is_random);
}

// Each run has directories of its own, whose names are not part of what the seed draws.
TEST(DiskFault, DrawsByThePathAsItIsWritten) {
  const auto identity_of = [](const std::string& path) {
    return plan_faults("<fault do=\"fill_disk\" path=\"" + path + "\" at=\"1..9\"/>").faults().at(0).identity;
  };
  EXPECT_EQ(identity_of("$(env HOME /a)"), identity_of("$(env HOME /a)"));
  EXPECT_EQ(identity_of("$(env PATH)").find("/usr/bin"), std::string::npos);
  EXPECT_NE(identity_of("/a"), identity_of("/b"));
}

TEST(DiskFault, AttributesGoTogether) {
  const auto error_of = [](const std::string& fault) { return plan_faults(fault).error; };
  EXPECT_EQ(error_of(R"(<fault do="fill_disk" process="p"/>)"),
            "/t.launch.xml:4:32: error: process does not go with do=\"fill_disk\": all processes of the test share the "
            "disk\n"
            "    4 | <fault do=\"fill_disk\" process=\"p\"/>\n"
            "      |                                ^");
  EXPECT_EQ(error_of(R"(<fault do="fill_disk" free="much"/>)"),
            "/t.launch.xml:4:29: error: 'much' is no amount of memory\n"
            "    4 | <fault do=\"fill_disk\" free=\"much\"/>\n"
            "      |                             ^~~~\n"
            "      = help: write bytes, or a number with K, M or G");
  EXPECT_EQ(error_of(R"(<fault do="fill_disk" path=""/>)"),
            "/t.launch.xml:4:29: error: the path of the disk is empty\n"
            "    4 | <fault do=\"fill_disk\" path=\"\"/>\n"
            "      |                             ^");
  EXPECT_EQ(error_of(R"(<fault process="p" do="kill" path="/a"/>)"),
            "/t.launch.xml:4:36: error: path goes with do=\"fill_disk\" only\n"
            "    4 | <fault process=\"p\" do=\"kill\" path=\"/a\"/>\n"
            "      |                                    ^~");
}

}  // namespace
}  // namespace launch
