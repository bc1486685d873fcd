// SPDX-License-Identifier: Apache-2.0
#include "launcher/machines/protocol/agent_protocol.hpp"

#include <fmt/format.h>

#include <charconv>

namespace launch {
namespace {

constexpr std::size_t kHead = 5;  // bytes in front of the content

void put_time(WireWriter& writer, const timeval& time) {
  writer.i64(time.tv_sec).i64(time.tv_usec);
}

timeval get_time(WireReader& reader) {
  timeval time{};
  time.tv_sec = reader.i64();
  time.tv_usec = reader.i64();
  if (time.tv_sec < 0 || time.tv_usec < 0 || time.tv_usec >= 1'000'000) {
    throw WireError("a message has a time that is none");
  }
  return time;
}

// It becomes a part of a path.
bool is_connection_number(const std::string& text) {
  return text.size() <= kLongestAgentId && text.find_first_not_of("0123456789abcdef") == std::string::npos;
}

}  // namespace

std::string agent_greeting(std::string_view launch_version) {
  return fmt::format("{}{} {}\n", kAgentGreeting, kAgentProtocol, launch_version);
}

std::optional<AgentVersion> parse_agent_greeting(std::string_view line) {
  if (line.ends_with('\r')) {
    line.remove_suffix(1);
  }
  if (!line.starts_with(kAgentGreeting)) {
    return std::nullopt;
  }
  line.remove_prefix(kAgentGreeting.size());
  AgentVersion version;
  const auto [end, error] = std::from_chars(line.data(), line.data() + line.size(), version.protocol);
  const auto behind = static_cast<std::size_t>(end - line.data());
  if (error != std::errc() || behind >= line.size() || line[behind] != ' ' || behind + 1 == line.size()) {
    return std::nullopt;
  }
  version.launch_version = line.substr(behind + 1);
  return version;
}

std::string encode_frame(std::uint8_t kind, std::string_view content) {
  if (content.size() > kLongestFrame) {
    throw WireError(fmt::format("a message of {} bytes is too long for a connection to another machine, which takes {}",
                                content.size(), kLongestFrame));
  }
  WireWriter frame;
  frame.u8(kind).text(content);
  return frame.bytes();
}

std::optional<Frame> Frames::take() {
  const std::string_view left = std::string_view(buffer_).substr(begin_);
  if (left.size() < kHead) {
    return std::nullopt;
  }
  WireReader head(left.substr(0, kHead));
  Frame frame;
  frame.kind = head.u8();
  const std::size_t length = head.u32();
  if (length > kLongestFrame) {
    throw WireError("what comes is no message of launch");
  }
  if (left.size() < kHead + length) {
    return std::nullopt;
  }
  frame.content = left.substr(kHead, length);
  begin_ += kHead + length;
  if (begin_ == buffer_.size() || begin_ > kStreamWindow) {
    buffer_.erase(0, begin_);
    begin_ = 0;
  }
  return frame;
}

std::string to_wire(const AgentSetup& setup) {
  WireWriter writer;
  writer.text(setup.setup).u32(setup.silence_milliseconds).text(setup.name);
  writer.u32(setup.wait_milliseconds).text(setup.id).text(setup.key);
  return writer.bytes();
}

AgentSetup parse_agent_setup(std::string_view bytes) {
  WireReader reader(bytes);
  AgentSetup setup;
  setup.setup = reader.text();
  setup.silence_milliseconds = reader.u32();
  setup.name = reader.text();
  setup.wait_milliseconds = reader.u32();
  setup.id = reader.text();
  setup.key = reader.text();
  reader.end();
  if (!is_connection_number(setup.id) || !is_connection_number(setup.key) || setup.id.empty() != setup.key.empty()) {
    throw WireError("the name of a connection is none");
  }
  return setup;
}

std::string to_wire(const ResumeRequest& request) {
  return WireWriter().text(request.id).text(request.key).u64(request.received).bytes();
}

ResumeRequest parse_resume_request(std::string_view bytes) {
  WireReader reader(bytes);
  ResumeRequest request;
  request.id = reader.text();
  request.key = reader.text();
  request.received = reader.u64();
  reader.end();
  if (request.id.empty() || request.key.empty() || !is_connection_number(request.id) ||
      !is_connection_number(request.key)) {
    throw WireError("the name of a connection is none");
  }
  return request;
}

std::string to_wire(const AgentHello& hello) {
  WireWriter writer;
  writer.text(hello.host).text(hello.architecture).text(hello.directory);
  writer.u32(static_cast<std::uint32_t>(hello.environment.size()));
  for (const auto& [name, value] : hello.environment) {
    writer.text(name).text(value);
  }
  writer.u32(static_cast<std::uint32_t>(hello.packages.size()));
  for (const AgentPackage& package : hello.packages) {
    writer.text(package.name).text(package.prefix).u32(static_cast<std::uint32_t>(package.programs.size()));
    for (const std::string& program : package.programs) {
      writer.text(program);
    }
  }
  writer.text(hello.own_prefix);
  return writer.bytes();
}

AgentHello parse_agent_hello(std::string_view bytes) {
  constexpr std::size_t kText = 4;  // bytes of an empty one
  WireReader reader(bytes);
  AgentHello hello;
  hello.host = reader.text();
  hello.architecture = reader.text();
  hello.directory = reader.text();
  for (std::uint32_t left = reader.count(2 * kText); left > 0; --left) {
    std::string name = reader.text();
    std::string value = reader.text();
    if (name.empty() || name.find('=') != std::string::npos || name.find('\0') != std::string::npos ||
        value.find('\0') != std::string::npos) {
      throw WireError("a variable of the environment has no proper name or value");
    }
    hello.environment.insert_or_assign(std::move(name), std::move(value));
  }
  for (std::uint32_t left = reader.count(3 * kText); left > 0; --left) {
    AgentPackage package;
    package.name = reader.text();
    package.prefix = reader.text();
    for (std::uint32_t programs = reader.count(kText); programs > 0; --programs) {
      package.programs.push_back(reader.text());
    }
    hello.packages.push_back(std::move(package));
  }
  hello.own_prefix = reader.text();
  reader.end();
  return hello;
}

void put(WireWriter& writer, const ProcessExit& exit) {
  writer.i32(exit.code).flag(exit.core_dumped).flag(exit.out_of_memory);
  put_time(writer, exit.usage.ru_utime);
  put_time(writer, exit.usage.ru_stime);
  writer.i64(exit.usage.ru_maxrss).i64(exit.usage.ru_minflt).i64(exit.usage.ru_majflt);
  writer.i64(exit.usage.ru_inblock).i64(exit.usage.ru_oublock).i64(exit.usage.ru_nvcsw).i64(exit.usage.ru_nivcsw);
}

ProcessExit get_exit(WireReader& reader) {
  constexpr int kLastSignal = 64;
  constexpr int kLastCode = 255;
  ProcessExit exit;
  exit.code = reader.i32();
  exit.core_dumped = reader.flag();
  exit.out_of_memory = reader.flag();
  exit.usage.ru_utime = get_time(reader);
  exit.usage.ru_stime = get_time(reader);
  exit.usage.ru_maxrss = reader.i64();
  exit.usage.ru_minflt = reader.i64();
  exit.usage.ru_majflt = reader.i64();
  exit.usage.ru_inblock = reader.i64();
  exit.usage.ru_oublock = reader.i64();
  exit.usage.ru_nvcsw = reader.i64();
  exit.usage.ru_nivcsw = reader.i64();
  if (exit.code < -kLastSignal || exit.code > kLastCode) {
    throw WireError("a message has an exit code that is none");
  }
  return exit;
}

}  // namespace launch
