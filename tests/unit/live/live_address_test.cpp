// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <string>

#include "tracing/decode/reader/live_reader.hpp"
#include "tracing/decode/reader/trace_read_error.hpp"

namespace tracing {
namespace {

TEST(LiveAddress, ANameIsASessionOfThisMachine) {
  std::array<char, 256> machine{};
  gethostname(machine.data(), machine.size() - 1);
  EXPECT_EQ(live_address("run").url(), "net://localhost/host/" + std::string(machine.data()) + "/run");
}

TEST(LiveAddress, AUrlNamesRelayHostAndSession) {
  const LiveAddress address = live_address("net://relay:1234/host/robot/run");
  EXPECT_EQ(address.relay, "relay:1234");
  EXPECT_EQ(address.host, "robot");
  EXPECT_EQ(address.session, "run");
  EXPECT_EQ(address.url(), "net://relay:1234/host/robot/run");
}

TEST(LiveAddress, AnythingElseIsAnError) {
  for (const char* text :
       {"http://relay/host/robot/run", "net://relay", "net://relay/host/robot", "net://relay/host/robot/"}) {
    try {
      live_address(text);
      ADD_FAILURE() << text;
    } catch (const TraceReadError& error) {
      EXPECT_EQ(error.what(), "'" + std::string(text) + "' is no address of a live session");
      EXPECT_EQ(error.remedy(), "write net://RELAY[:PORT]/host/HOST/SESSION, or the name of a session of this machine");
    }
  }
}

}  // namespace
}  // namespace tracing
