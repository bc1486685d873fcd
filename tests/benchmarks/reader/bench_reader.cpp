// SPDX-License-Identifier: Apache-2.0
// Reads one generated trace of four million events with babeltrace2, with our reader, with the installed library, with
// launch-trace-read, launch-report and with Python, and prints their speeds as ratios to `babeltrace2 -o dummy`, which
// decodes the same events and throws them away. Python stands beside babeltrace2's own module.
//
// Each reader is a process of its own. Its CPU time counts, so that other work on the machine has little effect; of
// programs with several threads the elapsed time is told, too. Usage:
//   bench_reader [EVENTS [PACKET_BYTES]]
//   bench_reader --write DIRECTORY EVENTS PACKET_BYTES  # writes the trace only, for a profiler
#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "launch_trace/reader.hpp"
#include "tests/benchmarks/samples/samples_file.hpp"
#include "tests/support/trace_writer/ping_pong_sequence.hpp"
#include "tests/support/trace_writer/temporary_directory.hpp"
#include "tests/support/trace_writer/trace_writer.hpp"
#include "tracing/decode/reader/ros2_decoder.hpp"
#include "tracing/decode/reader/trace_reader.hpp"

extern char** environ;

namespace {

using namespace tracing;

constexpr std::size_t kDefaultEvents = 4'000'000;
constexpr std::size_t kDefaultPacket = 64 << 10;
constexpr int kRounds = 3;  // the fastest counts

// Ping and pong, again and again: the initialisation once, then the exchange of a message every millisecond.
std::size_t write_trace(const std::filesystem::path& directory, std::size_t events, std::size_t packet_size) {
  testing::TraceWriter writer(directory, {.packet_size = packet_size});
  const std::vector<testing::SequenceEvent> sequence = testing::ping_pong_sequence();
  const auto first_of_exchange = std::find_if(sequence.begin(), sequence.end(), [](const auto& entry) {
    return std::holds_alternative<ros2::CallbackStart>(entry.event);
  });
  const auto write = [&](const testing::SequenceEvent& entry, std::int64_t later_ns) {
    ros2::AnyEvent event = entry.event;
    if (auto* publish = std::get_if<ros2::RmwPublish>(&event)) {
      publish->timestamp += later_ns;
    }
    if (auto* take = std::get_if<ros2::RmwTake>(&event)) {
      take->source_timestamp += later_ns;
    }
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

// Asks for the value of every field.
template <class Event>
std::uint64_t sum_of_fields(const Event& event, std::size_t fields) {
  std::uint64_t sum = 0;
  for (std::size_t i = 0; i < fields; ++i) {
    const auto field = event.field(i);
    if (const auto number = field.unsigned_integer()) {
      sum += *number;
    } else if (const auto with_sign = field.integer()) {
      sum += static_cast<std::uint64_t>(*with_sign);
    } else if (const auto text = field.string()) {
      sum += text->size();
    }
  }
  return sum;
}

class CountingSink : public TraceSink {
 public:
  std::size_t events = 0;
  void on_event(const Event&) override { ++events; }
  void on_loss(const Loss&) override {}
};

class FieldSink : public TraceSink {
 public:
  std::uint64_t sum = 0;
  void on_event(const Event& event) override { sum += sum_of_fields(event, event.event_class->fields.size()); }
  void on_loss(const Loss&) override {}
};

std::uint64_t read_with_library(const std::string& trace) {
  std::uint64_t sum = 0;
  launch_trace::Reader reader(trace);
  for (const launch_trace::Item& item : reader) {
    if (const auto* const event = item.event()) {
      sum += sum_of_fields(*event, event->event_class().fields.size());
    }
  }
  return sum;
}

class DecodingSink : public TraceSink {
 public:
  std::size_t ros2_events = 0;
  void on_event(const Event& event) override {
    if (decoder_.decode(event) != nullptr) {
      ++ros2_events;
    }
  }
  void on_loss(const Loss&) override {}

 private:
  ros2::Decoder decoder_{[](const std::string&) {}};
};

struct Seconds {
  double processor = 0;
  double elapsed = 0;
};

// Of a command; its output is thrown away.
Seconds seconds_of(const std::vector<std::string>& command) {
  std::vector<char*> arguments;
  for (const std::string& argument : command) {
    arguments.push_back(const_cast<char*>(argument.c_str()));
  }
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, 1, "/dev/null", O_WRONLY, 0);
  pid_t child = 0;
  const auto begin = std::chrono::steady_clock::now();
  const int error = posix_spawnp(&child, arguments[0], &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (error != 0) {
    throw std::runtime_error(fmt::format("cannot run {}", command[0]));
  }
  int status = 0;
  rusage usage{};
  if (wait4(child, &status, 0, &usage) != child || status != 0) {
    throw std::runtime_error(fmt::format("{} failed", command[0]));
  }
  const auto seconds = [](const timeval& time) {
    return static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_usec) / 1e6;
  };
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - begin;
  return {seconds(usage.ru_utime) + seconds(usage.ru_stime), elapsed.count()};
}

void compare(const std::string& self, std::size_t events, std::size_t packet_size) {
  const testing::TemporaryDirectory directory;
  const std::string trace = directory.path() / "trace";
  events = write_trace(trace, events, packet_size);

  struct Reader {
    std::string name;
    std::vector<std::string> command;
    bool has_threads = false;
    std::vector<double> processor = {};  // seconds of each round
    std::vector<double> elapsed = {};
  };
  std::vector<Reader> readers{
      {"babeltrace2 -o dummy", {"babeltrace2", "-o", "dummy", trace}},
      {"launch trace read --count", {LAUNCH_TRACE_READ, "--count", trace}, true},
      {"reader, all fields at hand", {self, "--count", trace}, true},
      {"reader, every field asked for", {self, "--fields", trace}, true},
      {"installed library, the same", {self, "--library", trace}},
      {"reader, ros2 events as structs", {self, "--structs", trace}, true},
      {"launch report", {LAUNCH_REPORT, trace}, true},
      {"launch report --summary", {LAUNCH_REPORT, "--summary", trace}, true},
  };
  for (int round = 0; round < kRounds; ++round) {
    for (Reader& reader : readers) {
      const Seconds took = seconds_of(reader.command);
      reader.processor.push_back(took.processor);
      reader.elapsed.push_back(took.elapsed);
    }
  }
  fmt::print("{} events in 2 streams, with vpid, vtid and procname, packets of {} KiB; best of {}\n", events,
             packet_size >> 10, kRounds);
  const auto print = [&](const std::string& name, const std::vector<double>& seconds,
                         const std::vector<double>& floor) {
    const double best = *std::min_element(seconds.begin(), seconds.end());
    fmt::print("{:<40} {:6.2f} M events/s   {:5.2f} of babeltrace2's speed\n", name,
               static_cast<double>(events) / best / 1e6, *std::min_element(floor.begin(), floor.end()) / best);
    const auto speeds = [&](const std::vector<double>& of) {
      std::vector<double> values;
      for (const double one : of) {
        values.push_back(static_cast<double>(events) / one / 1e6);
      }
      return values;
    };
    benchmarks::report({name, "M events/s", speeds(seconds), readers[0].name, speeds(floor), true});
  };
  for (const Reader& reader : readers) {
    print(reader.name, reader.processor, readers[0].processor);
    if (reader.has_threads) {
      print(reader.name + ", elapsed", reader.elapsed, readers[0].elapsed);
    }
  }
  std::fflush(stdout);
#ifdef PYTHON
  setenv("PYTHONPATH", PYTHON_MODULE_DIRECTORY, 1);
  if (const std::string command = fmt::format("{} {} {}", PYTHON, ITERATE_TRACE, trace);
      std::system(command.c_str()) != 0) {
    throw std::runtime_error(command + " failed");
  }
#endif
}

}  // namespace

int main(int argc, char** argv) {
  if (argc == 5 && argv[1] == std::string_view("--write")) {
    write_trace(argv[2], std::stoul(argv[3]), std::stoul(argv[4]));
    return EXIT_SUCCESS;
  }
  if (argc == 3 &&
      std::string_view(argv[1]).starts_with("--")) {  // compare() runs this to measure one way of reading alone
    const std::string way = argv[1];
    if (way == "--structs") {
      DecodingSink sink;
      TraceReader(argv[2]).read(sink);
      return sink.ros2_events > 0 ? EXIT_SUCCESS : EXIT_FAILURE;
    }
    if (way == "--library") {
      return read_with_library(argv[2]) > 0 ? EXIT_SUCCESS : EXIT_FAILURE;
    }
    if (way == "--count") {
      CountingSink sink;
      TraceReader(argv[2]).read(sink);
      return sink.events > 0 ? EXIT_SUCCESS : EXIT_FAILURE;
    }
    FieldSink sink;
    TraceReader(argv[2]).read(sink);
    return sink.sum > 0 ? EXIT_SUCCESS : EXIT_FAILURE;
  }
  compare(argv[0], argc > 1 ? std::stoul(argv[1]) : kDefaultEvents, argc > 2 ? std::stoul(argv[2]) : kDefaultPacket);
  return EXIT_SUCCESS;
}
