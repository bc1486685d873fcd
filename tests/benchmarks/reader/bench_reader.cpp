// SPDX-License-Identifier: Apache-2.0
// Reads one generated trace of a million events with babeltrace2, with our reader, and with launch-report, and prints
// their speeds as ratios to `babeltrace2 -o dummy`, which decodes the same events and throws them away.
//
// Each reader is a process of its own. Its CPU time counts, so that other work on the machine has little effect. Usage:
//   bench_reader [EVENTS]
#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>

#include <algorithm>
#include <cstdlib>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/support/trace_writer/ping_pong_sequence.hpp"
#include "tests/support/trace_writer/temporary_directory.hpp"
#include "tests/support/trace_writer/trace_writer.hpp"
#include "tracing/reader/ros2_decoder.hpp"
#include "tracing/reader/trace_reader.hpp"

extern char** environ;

namespace {

using namespace tracing;

constexpr std::size_t kDefaultEvents = 1'000'000;
constexpr int kRounds = 3;  // the fastest counts

// Ping and pong, again and again: the initialisation once, then the exchange of a message every millisecond.
std::size_t write_trace(const std::filesystem::path& directory, std::size_t events) {
  testing::TraceWriter writer(directory);
  const std::vector<testing::SequenceEvent> sequence = testing::ping_pong_sequence();
  const auto first_of_exchange = std::find_if(sequence.begin(), sequence.end(), [](const auto& entry) {
    return std::holds_alternative<ros2::CallbackStart>(entry.event);
  });
  const auto write = [&](const testing::SequenceEvent& entry, std::int64_t later_ns) {
    ros2::AnyEvent event = entry.event;
    if (auto* publish = std::get_if<ros2::RmwPublish>(&event)) publish->timestamp += later_ns;
    if (auto* take = std::get_if<ros2::RmwTake>(&event)) take->source_timestamp += later_ns;
    writer.write(entry.thread.vpid == testing::kPing.vpid ? 0 : 1, entry.time_ns + later_ns, entry.thread, event);
  };
  std::size_t written = 0;
  for (const testing::SequenceEvent& entry : sequence) {
    write(entry, 0);
    ++written;
  }
  for (std::int64_t later_ns = 1'000'000; written < events; later_ns += 1'000'000) {
    for (auto entry = first_of_exchange; entry != sequence.end(); ++entry) {
      write(*entry, later_ns);
      ++written;
    }
  }
  writer.finish();
  return written;
}

class DecodingSink : public TraceSink {
 public:
  std::size_t ros2_events = 0;
  void on_event(const Event& event) override {
    if (decoder_.decode(event) != nullptr) ++ros2_events;
  }
  void on_loss(const Loss&) override {}

 private:
  ros2::Decoder decoder_{[](const std::string&) {}};
};

// CPU seconds of a command; its output is thrown away.
double cpu_seconds_of(const std::vector<std::string>& command) {
  std::vector<char*> arguments;
  for (const std::string& argument : command) arguments.push_back(const_cast<char*>(argument.c_str()));
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, 1, "/dev/null", O_WRONLY, 0);
  pid_t child = 0;
  const int error = posix_spawnp(&child, arguments[0], &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (error != 0) throw std::runtime_error(fmt::format("cannot run {}", command[0]));
  int status = 0;
  rusage usage{};
  if (wait4(child, &status, 0, &usage) != child || status != 0) {
    throw std::runtime_error(fmt::format("{} failed", command[0]));
  }
  const auto seconds = [](const timeval& time) {
    return static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_usec) / 1e6;
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

void compare(const std::string& self, std::size_t events) {
  const testing::TemporaryDirectory directory;
  const std::string trace = directory.path() / "trace";
  events = write_trace(trace, events);

  struct Reader {
    std::string name;
    std::vector<std::string> command;
    double seconds = std::numeric_limits<double>::max();
  };
  std::vector<Reader> readers{
      {"babeltrace2 -o dummy", {"babeltrace2", "-o", "dummy", trace}},
      {"reader, all fields decoded", {self, "--read", trace}},
      {"launch report", {LAUNCH_REPORT, trace}},
      {"launch report --summary", {LAUNCH_REPORT, "--summary", trace}},
  };
  for (int round = 0; round < kRounds; ++round) {
    for (Reader& reader : readers) reader.seconds = std::min(reader.seconds, cpu_seconds_of(reader.command));
  }
  fmt::print("{} events in 2 streams, with vpid, vtid and procname; CPU time, best of {}\n", events, kRounds);
  for (const Reader& reader : readers) {
    fmt::print("{:<28} {:6.2f} M events/s   {:5.2f} of babeltrace2's speed\n", reader.name,
               static_cast<double>(events) / reader.seconds / 1e6, readers[0].seconds / reader.seconds);
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc == 3 && std::string(argv[1]) == "--read") {  // compare() runs this to measure the reader alone
    DecodingSink sink;
    TraceReader(argv[2]).read(sink);
    return sink.ros2_events > 0 ? EXIT_SUCCESS : EXIT_FAILURE;
  }
  compare(argv[0], argc == 2 ? std::stoul(argv[1]) : kDefaultEvents);
  return EXIT_SUCCESS;
}
