// SPDX-License-Identifier: Apache-2.0
#include "launcher/machines/protocol/agent_protocol.hpp"

#include <gmock/gmock.h>

#include <random>
#include <string>

#include "launcher/machines/protocol/spec_wire.hpp"

namespace {

using namespace launch;
using testing::ElementsAre;

std::string all_bytes() {
  std::string text;
  for (int byte = 0; byte < 256; ++byte) {
    text += static_cast<char>(byte);
  }
  return text;
}

ProcessSpec full_spec() {
  ProcessSpec spec;
  spec.name = "talker";
  spec.label = "talker-3";
  spec.machine = "arm";
  spec.argv = {"/opt/talker", "--ros-args", "--params-file", ""};
  spec.environment = Environment({{"A", "1"}, {"ODD", "\xff\x01=\n"}});
  spec.working_directory = "/tmp";
  spec.shell = true;
  spec.emulate_tty = true;
  spec.output.out = {.screen = true, .log = false, .own_log = true};
  spec.limits.niceness = -5;
  spec.limits.cpus = {0, 2};
  spec.limits.memory = std::uint64_t{1} << 40U;
  spec.limits.timer_slack = std::chrono::nanoseconds(1000);
  spec.limits.schedule.runtime = std::chrono::milliseconds(2);
  spec.sigterm_timeout = std::chrono::milliseconds(1500);
  spec.files = {{3, "talker/params.yaml", "a: 1\n"}};
  return spec;
}

TEST(AgentProtocol, FramesComeInAnyPieces) {
  const std::string stream = encode(FromAgent::kOutput, WireWriter().u32(7).u8(1).rest(all_bytes())) +
                             encode(FromAgent::kClosed, WireWriter().u32(7).u8(1)) + encode(ToAgent::kEnd);
  for (std::size_t piece = 1; piece <= stream.size(); ++piece) {
    Frames frames;
    std::vector<Frame> got;
    for (std::size_t begin = 0; begin < stream.size(); begin += piece) {
      frames.add(std::string_view(stream).substr(begin, piece));
      while (auto frame = frames.take()) {
        got.push_back(*std::move(frame));
      }
    }
    ASSERT_EQ(got.size(), 3U);
    WireReader reader(got[0].content);
    EXPECT_EQ(reader.u32(), 7U);
    EXPECT_EQ(reader.u8(), 1);
    EXPECT_EQ(reader.rest(), all_bytes());
    EXPECT_EQ(static_cast<ToAgent>(got[2].kind), ToAgent::kEnd);
    EXPECT_EQ(got[2].content, "");
    EXPECT_EQ(frames.held(), 0U);
  }
}

TEST(AgentProtocol, AFrameThatIsTooLongIsNone) {
  Frames frames;
  frames.add("Last login: Sat Nov 28");
  EXPECT_THROW(frames.take(), WireError);
  EXPECT_THROW(encode_frame(1, std::string(kLongestFrame + 1, 'x')), WireError);
  Frames longest;
  longest.add(encode_frame(1, std::string(kLongestFrame, 'x')));
  EXPECT_EQ(longest.take()->content.size(), kLongestFrame);
}

TEST(AgentProtocol, GreetingIsALineOfItsOwn) {
  EXPECT_EQ(agent_greeting("1.0.0"), "launch-agent 2 1.0.0\n");
  EXPECT_EQ(parse_agent_greeting("launch-agent 3 1.0.0\r")->protocol, 3);
  EXPECT_EQ(parse_agent_greeting("launch-agent 1 1.0.0")->launch_version, "1.0.0");
  for (const char* const line : {"", "launch-agent", "launch-agent 1", "launch-agent 1 ", "launch-agent x 1.0.0",
                                 "launch-agent 99999999999 1.0.0", "Welcome, launch-agent 1 1.0.0"}) {
    EXPECT_FALSE(parse_agent_greeting(line)) << line;
  }
}

TEST(AgentProtocol, ASpecArrivesAsItIs) {
  WireWriter writer;
  put(writer, full_spec());
  WireReader reader(writer.bytes());
  const ProcessSpec spec = get_spec(reader);
  EXPECT_EQ(spec.name, "talker");
  EXPECT_EQ(spec.label, "talker-3");
  EXPECT_THAT(spec.argv, ElementsAre("/opt/talker", "--ros-args", "--params-file", ""));
  EXPECT_EQ(spec.environment, full_spec().environment);
  EXPECT_EQ(spec.working_directory, "/tmp");
  EXPECT_TRUE(spec.shell);
  EXPECT_TRUE(spec.emulate_tty);
  EXPECT_EQ(spec.output, full_spec().output);
  EXPECT_EQ(describe(spec.limits), describe(full_spec().limits));
  EXPECT_EQ(spec.limits.schedule.runtime, std::chrono::milliseconds(2));
  EXPECT_EQ(spec.sigterm_timeout, std::chrono::milliseconds(1500));
  EXPECT_EQ(spec.files.at(0).content, "a: 1\n");
}

TEST(AgentProtocol, AHelloArrivesAsItIs) {
  AgentHello hello;
  hello.host = "arm";
  hello.architecture = "aarch64";
  hello.environment = {{"HOME", "/home/robot"}};
  hello.packages = {{"demo", "/opt/demo", {"listener", "talker"}}, {"empty", "/opt/empty", {}}};
  hello.own_prefix = "/usr";
  const AgentHello got = parse_agent_hello(to_wire(hello));
  EXPECT_EQ(got.architecture, "aarch64");
  EXPECT_EQ(got.environment, hello.environment);
  ASSERT_EQ(got.packages.size(), 2U);
  EXPECT_THAT(got.packages[0].programs, ElementsAre("listener", "talker"));
  EXPECT_EQ(got.packages[1].prefix, "/opt/empty");
  EXPECT_EQ(got.own_prefix, "/usr");
}

TEST(AgentProtocol, AnExitArrivesAsItIs) {
  ProcessExit exit;
  exit.code = -11;
  exit.core_dumped = true;
  exit.usage.ru_utime = {3, 250000};
  exit.usage.ru_maxrss = 1234;
  WireWriter writer;
  put(writer, exit);
  WireReader reader(writer.bytes());
  const ProcessExit got = get_exit(reader);
  reader.end();
  EXPECT_EQ(got.code, -11);
  EXPECT_TRUE(got.core_dumped);
  EXPECT_EQ(got.usage.ru_utime.tv_usec, 250000);
  EXPECT_EQ(got.usage.ru_maxrss, 1234);
  EXPECT_FALSE(got.lost);
}

// Whatever the bytes are, they are read or refused, and take no more memory than they have.
template <typename Read>
void read_hostile(const std::string& good, Read read) {
  const auto attempt = [&](const std::string& bytes) {
    try {
      read(bytes);
    } catch (const WireError&) {
      // refused
    }
  };
  for (std::size_t size = 0; size < good.size(); ++size) {
    EXPECT_THROW(read(good.substr(0, size)), WireError) << size;
  }
  std::mt19937 random(1);
  for (int round = 0; round < 20000; ++round) {
    std::string bytes = good;
    for (unsigned changes = random() % 8 + 1; changes > 0; --changes) {
      bytes[random() % bytes.size()] = static_cast<char>(random() % 4 == 0 ? 0xff : random());
    }
    attempt(bytes);
  }
}

TEST(AgentProtocol, HostileSpecsAreRefused) {
  WireWriter writer;
  put(writer, full_spec());
  read_hostile(writer.bytes(), [](const std::string& bytes) {
    WireReader reader(bytes);
    const ProcessSpec spec = get_spec(reader);
    for (const GeneratedFile& file : spec.files) {
      ASSERT_LT(file.argument, spec.argv.size());
    }
  });
}

TEST(AgentProtocol, HostileHellosAreRefused) {
  AgentHello hello;
  hello.host = "arm";
  hello.environment = {{"HOME", "/home/robot"}, {"PATH", "/usr/bin"}};
  hello.packages = {{"demo", "/opt/demo", {"talker"}}};
  read_hostile(to_wire(hello), [](const std::string& bytes) { parse_agent_hello(bytes); });
}

TEST(AgentProtocol, AListThatPromisesMoreThanComesIsRefused) {
  WireWriter writer;
  writer.text("host").text("arch").text("dir").u32(0xffffffffU);
  EXPECT_THROW(parse_agent_hello(writer.bytes()), WireError);
}

TEST(AgentProtocol, VariablesWithoutAProperNameAreRefused) {
  for (const auto& [name, value] : {std::pair<std::string, std::string>{"", "x"},
                                    {"A=B", "x"},
                                    {std::string("A\0B", 3), "x"},
                                    {"A", std::string("x\0y", 3)}}) {
    WireWriter writer;
    writer.text("").text("").text("").u32(1).text(name).text(value).u32(0).text("");
    EXPECT_THROW(parse_agent_hello(writer.bytes()), WireError);
  }
}

TEST(AgentProtocol, AProcessWithoutAProgramIsRefused) {
  ProcessSpec spec = full_spec();
  spec.files.clear();
  for (const std::vector<std::string>& argv : {std::vector<std::string>{}, {""}, {std::string("a\0b", 3)}}) {
    spec.argv = argv;
    WireWriter writer;
    put(writer, spec);
    WireReader reader(writer.bytes());
    EXPECT_THROW(get_spec(reader), WireError);
  }
}

}  // namespace
