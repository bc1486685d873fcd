// SPDX-License-Identifier: Apache-2.0
// Counting gives what reading gives, or says that the trace must be read.
#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <optional>
#include <random>
#include <sstream>
#include <string>
#include <tuple>
#include <vector>

#include "tests/support/trace_writer/random_trace.hpp"
#include "tests/support/trace_writer/temporary_directory.hpp"
#include "tests/support/trace_writer/trace_writer.hpp"
#include "tracing/decode/reader/trace_reader.hpp"

namespace tracing {
namespace {

namespace fs = std::filesystem;
using testing::TemporaryDirectory;
using testing::TraceWriter;

struct Counted : TraceSink {
  std::map<std::size_t, std::uint64_t> events;  // by EventClass::id
  // How often: stream, kind, begin, end, count.
  std::map<std::tuple<std::string, Loss::Kind, std::optional<std::int64_t>, std::optional<std::int64_t>,
                      std::optional<std::uint64_t>>,
           int>
      losses;
  std::string error;

  void on_event(const Event& event) override { ++events[event.event_class->id]; }
  void on_loss(const Loss& loss) override {
    ++losses[{loss.stream->name, loss.kind, loss.begin_ns, loss.end_ns, loss.count}];
  }
  bool operator==(const Counted& other) const {
    return events == other.events && losses == other.losses && error == other.error;
  }
};

Counted counted_by_reading(const fs::path& directory) {
  Counted sink;
  try {
    TraceReader(directory, TraceReader::Decoder::kDirect).read(sink);
  } catch (const TraceReadError& error) {
    sink.error = error.what();
  }
  return sink;
}

// Nullopt: the events must be read. Reading then gives what it gives without counting.
std::optional<Counted> counted(const fs::path& directory) {
  TraceReader reader(directory, TraceReader::Decoder::kDirect);
  Counted result;
  const std::optional<EventCounts> counts = reader.count();
  try {
    if (counts) {
      for (const auto& [event_class, events] : counts->events) {
        EXPECT_GT(events, 0u);
        result.events[event_class->id] += events;
      }
      for (const Loss& loss : counts->losses) {
        result.on_loss(loss);
      }
      reader.throw_damage();
    } else {
      reader.read(result);
    }
  } catch (const TraceReadError& error) {
    result.error = error.what();
  }
  EXPECT_TRUE(result == counted_by_reading(directory));
  return counts ? std::optional(result) : std::nullopt;
}

TEST(EventCounts, AreThoseOfReading) {
  std::uint64_t events = 0;
  std::size_t losses = 0;
  for (std::uint32_t seed = 0; seed < 120; ++seed) {
    const TemporaryDirectory directory;
    testing::write_random_trace(directory.path(), seed);
    SCOPED_TRACE(seed);
    const std::optional<Counted> result = counted(directory.path());
    ASSERT_TRUE(result);
    for (const auto& [event_class, of_class] : result->events) {
      events += of_class;
    }
    losses += result->losses.size();
  }
  EXPECT_GT(events, 1000u) << "the traces hold something to compare";
  EXPECT_GT(losses, 10u);
}

TEST(EventCounts, AreNotToldWhereAPacketIsDamaged) {
  int told = 0;
  int not_told = 0;
  for (std::uint32_t seed = 0; seed < 60; ++seed) {
    const TemporaryDirectory directory;
    testing::write_random_trace(directory.path(), seed);
    std::ostringstream text;
    text << std::ifstream(directory.path() / "channel_0", std::ios::binary).rdbuf();
    const std::string whole = text.str();
    std::mt19937 random(seed);
    for (int round = 0; round < 10; ++round) {
      std::string damaged = whole;
      for (int i = 0; i < 4; ++i) {
        damaged[random() % damaged.size()] = static_cast<char>(random());
      }
      if (round % 3 == 0) {
        damaged.resize(random() % damaged.size());
      }
      std::ofstream(directory.path() / "channel_0", std::ios::binary) << damaged;
      SCOPED_TRACE(seed);
      ++(counted(directory.path()) ? told : not_told);
    }
  }
  EXPECT_GT(told, 50);
  EXPECT_GT(not_told, 20);
}

// Several threads share the packets of all streams, and each packet is read in parts.
TEST(EventCounts, AreThoseOfAllThreads) {
  const TemporaryDirectory directory;
  TraceWriter writer(directory.path(), {.packet_size = 1 << 20});
  const std::uint16_t id = writer.declare("a:text", "string _text;");
  for (int stream = 0; stream < 3; ++stream) {
    for (std::int64_t i = 0; i < 60'000; ++i) {
      writer.write(stream, i, {1, 1, "a"}, ros2::RclTake{1});
      if (i % 7 == 0) {
        writer.write_raw(stream, i, {1, 1, "a"}, id, std::string(static_cast<std::size_t>(i) % 1200, 'x') + '\0');
      }
    }
  }
  writer.finish();
  const std::optional<Counted> result = counted(directory.path());
  ASSERT_TRUE(result);
  EXPECT_EQ(result->events.size(), 2u);
}

}  // namespace
}  // namespace tracing
