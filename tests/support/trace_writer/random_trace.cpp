// SPDX-License-Identifier: Apache-2.0
#include "tests/support/trace_writer/random_trace.hpp"

#include <fmt/format.h>

#include <fstream>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "tests/support/trace_writer/bit_writer.hpp"
#include "tests/support/trace_writer/random_fields.hpp"

namespace tracing::testing {
namespace {

class RandomTraceWriter {
 public:
  RandomTraceWriter(std::filesystem::path directory, std::function<std::uint64_t()> random)
      : directory_(std::move(directory)),
        random_(std::move(random)),
        big_endian_(below(4) == 0),
        fields_(random_, below(3) == 0) {
    std::filesystem::create_directories(directory_);
    compact_ = below(2) == 0;
    clock_bits_ = compact_ ? 27 : 32;
    contexts_ = below(2) == 0;
    for (std::uint64_t i = 0, count = 1 + below(6); i < count; ++i) {
      events_.push_back(random_event());
    }
    context_ = below(2) == 0 ? fields_.usual_contexts() : fields_.structure(1);
  }

  void write() {
    const std::size_t streams = 1 + below(3);
    for (std::size_t stream = 0; stream < streams; ++stream) {
      write_stream(stream);
    }
    std::ofstream(directory_ / "metadata") << metadata();
  }

 private:
  std::uint64_t below(std::uint64_t limit) { return random_() % limit; }

  struct RandomEvent {
    std::optional<RandomField> context;  // of this event alone
    RandomField fields;
  };

  RandomEvent random_event() {
    RandomEvent event;
    // libbabeltrace2 2.0.4 ends the program (Assertion `tgt_fc` failed) at a sequence or a variant in such a context.
    if (below(4) == 0) {
      event.context = fields_.structure(0);
    }
    event.fields = fields_.structure(3);
    return event;
  }

  void write_stream(std::size_t stream) {
    std::string file;
    std::uint64_t clock = 1'000'000'000 + below(1'000'000'000);
    std::uint64_t discarded = 0;
    std::uint64_t sequence = below(3);
    for (std::uint64_t packet = 0, count = 1 + below(4); packet < count; ++packet) {
      if (below(4) == 0) {
        discarded += below(100);
      }
      if (below(4) == 0) {
        sequence += below(5);
      }
      clock += below(1'000'000);
      file += packet_bytes(stream, clock, sequence++, discarded);
    }
    std::ofstream(directory_ / fmt::format("channel_{}", stream), std::ios::binary) << file;
  }

  std::string packet_bytes(std::size_t stream, std::uint64_t& clock, std::uint64_t sequence, std::uint64_t discarded) {
    BitWriter out(big_endian_);
    out.number(0xC1FC1FC1, 32);
    for (int i = 0; i < 16; ++i) {
      out.number(0x11, 8);
    }
    out.number(0, 32);
    out.number(stream, 64);
    out.number(clock, 64);
    const std::uint64_t sizes = out.size();
    for (int i = 0; i < 3; ++i) {
      out.number(0, 64);
    }
    out.number(sequence, 64);
    out.number(discarded, 64);
    out.number(stream, 32);
    for (std::uint64_t i = 0, count = below(40); i < count; ++i) {
      write_event(out, clock);
    }
    const std::uint64_t content = out.size();
    out.align(8);
    out.patch(sizes, clock, 64);
    out.patch(sizes + 64, content, 64);
    std::string bytes = out.bytes();
    bytes.append(below(100), '\0');
    BitWriter size(big_endian_);
    size.number(bytes.size() * 8, 64);
    bytes.replace((sizes + 128) / 8, 8, size.bytes());
    return bytes;
  }

  void write_event(BitWriter& out, std::uint64_t& clock) {
    // The step is longer than the clock's lower bits hold, so only the long header can express it.
    const bool is_long = below(8) == 0;
    clock += is_long ? std::uint64_t{1} << clock_bits_ : below(1U << 26);
    const std::uint64_t event = below(events_.size());
    out.align(8);
    if (compact_) {
      out.number(is_long ? 31 : event, 5);
    } else {
      out.number(is_long ? 65535 : event, 16);
    }
    if (is_long) {
      out.align(8);
      out.number(event, 32);
      out.number(clock, 64);
    } else {
      if (!compact_) {
        out.align(8);
      }
      out.number(clock, clock_bits_);
    }
    if (contexts_) {
      context_.write(out);
    }
    if (events_[event].context) {
      events_[event].context->write(out);
    }
    events_[event].fields.write(out);
  }

  std::string metadata() const {
    std::string text = fmt::format(
        "/* CTF 1.8 */\n"
        "trace {{ major = 1; minor = 8; uuid = \"11111111-1111-1111-1111-111111111111\"; byte_order = {};\n"
        "  packet.header := struct {{ integer {{ size = 32; align = 8; }} magic;\n"
        "    integer {{ size = 8; align = 8; }} uuid[16]; integer {{ size = 32; align = 8; }} stream_id;\n"
        "    integer {{ size = 64; align = 8; }} stream_instance_id; }};\n}};\n"
        "clock {{ name = monotonic; freq = 1000000000; offset_s = 1700000000; offset = 12345; }};\n"
        "typealias integer {{ size = 64; align = 8; map = clock.monotonic.value; }} := clock_t;\n"
        "typealias integer {{ size = {}; align = {}; map = clock.monotonic.value; }} := lower_t;\n"
        "typealias integer {{ size = 32; align = 8; }} := uint32_t;\n"
        "typealias integer {{ size = 64; align = 8; }} := unsigned long;\n"
        "struct packet_context {{ clock_t timestamp_begin; clock_t timestamp_end; unsigned long content_size;\n"
        "  unsigned long packet_size; unsigned long packet_seq_num; unsigned long events_discarded; uint32_t cpu_id; "
        "}};\n"
        "struct header {{ enum : integer {{ size = {}; align = {}; }} {{ compact = 0 ... {}, extended = {} }} id;\n"
        "  variant <id> {{ struct {{ lower_t timestamp; }} compact;\n"
        "    struct {{ uint32_t id; clock_t timestamp; }} extended; }} v;\n}} align(8);\n"
        "stream {{ id = 0; packet.context := struct packet_context; event.header := struct header;\n",
        big_endian_ ? "be" : "le", clock_bits_, compact_ ? 1 : 8, compact_ ? 5 : 16, compact_ ? 1 : 8,
        compact_ ? 30 : 65534, compact_ ? 31 : 65535);
    if (contexts_) {
      text += fmt::format("  event.context := struct {{ {} }};\n", context_.declaration);
    }
    text += "};\n";
    for (std::size_t i = 0; i < events_.size(); ++i) {
      const RandomEvent& event = events_[i];
      text += fmt::format("event {{ name = \"random:event{}\"; id = {}; stream_id = 0;\n", i, i);
      if (event.context) {
        text += fmt::format("  context := struct {{\n{} }};\n", event.context->declaration);
      }
      text += fmt::format("  fields := struct {{\n{} }}; }};\n", event.fields.declaration);
    }
    return text;
  }

  std::filesystem::path directory_;
  std::function<std::uint64_t()> random_;
  bool big_endian_;
  RandomFields fields_;
  bool compact_ = false;
  bool contexts_ = false;
  std::uint32_t clock_bits_ = 0;
  std::vector<RandomEvent> events_;
  RandomField context_;
};

}  // namespace

void write_random_trace(const std::filesystem::path& directory, std::uint32_t seed) {
  write_random_trace(directory, std::mt19937_64(seed));
}

void write_random_trace(const std::filesystem::path& directory, std::function<std::uint64_t()> random) {
  RandomTraceWriter(directory, std::move(random)).write();
}

}  // namespace tracing::testing
