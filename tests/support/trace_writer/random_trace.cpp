// SPDX-License-Identifier: Apache-2.0
#include "tests/support/trace_writer/random_trace.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <fstream>
#include <functional>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace tracing::testing {
namespace {

// Bits in the order of CTF: little-endian numbers begin at the lowest bit of each byte, big-endian numbers at the
// highest.
class BitWriter {
 public:
  explicit BitWriter(bool big_endian) : big_endian_(big_endian) {}

  void align(std::uint32_t alignment) {
    while (size_ % alignment != 0) {
      bit(false);
    }
  }
  void number(std::uint64_t value, std::uint32_t bits) {
    for (std::uint32_t i = 0; i < bits; ++i) {
      bit(((value >> (big_endian_ ? bits - 1 - i : i)) & 1) != 0);
    }
  }
  void text(const std::string& text) {
    for (const char c : text) {
      number(static_cast<std::uint8_t>(c), 8);
    }
    number(0, 8);
  }
  std::uint64_t size() const { return size_; }
  void patch(std::uint64_t at, std::uint64_t value, std::uint32_t bits) {
    const std::uint64_t end = std::exchange(size_, at);
    number(value, bits);
    size_ = end;
  }
  const std::string& bytes() const { return bytes_; }

 private:
  void bit(bool set) {
    if (size_ / 8 == bytes_.size()) {
      bytes_.push_back('\0');
    }
    const auto mask = static_cast<char>(1U << (big_endian_ ? 7 - size_ % 8 : size_ % 8));
    char& byte = bytes_[size_ / 8];
    byte = static_cast<char>(set ? byte | mask : byte & ~mask);
    ++size_;
  }

  bool big_endian_;
  std::string bytes_;
  std::uint64_t size_ = 0;
};

// A field: its declaration in the metadata, with @ for its name, and a function that writes a value.
struct RandomField {
  std::string declaration;
  std::uint32_t alignment = 1;
  std::function<void(BitWriter&)> write;
};

class RandomTraceWriter {
 public:
  RandomTraceWriter(std::filesystem::path directory, std::function<std::uint64_t()> random)
      : directory_(std::move(directory)), random_(std::move(random)) {
    std::filesystem::create_directories(directory_);
    big_endian_ = below(4) == 0;
    natural_ = below(3) == 0;
    compact_ = below(2) == 0;
    clock_bits_ = compact_ ? 27 : 32;
    contexts_ = below(2) == 0;
    for (std::uint64_t i = 0, count = 1 + below(6); i < count; ++i) {
      events_.push_back(random_event());
    }
    context_ = below(2) == 0 ? usual_contexts() : structure(1);
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
  std::uint32_t number_alignment(std::uint32_t size) const {
    return natural_ && std::has_single_bit(size) && size >= 8 ? size : 8;
  }

  static std::string integer(std::uint32_t size, std::uint32_t alignment, bool is_signed, const char* rest = "") {
    return fmt::format("integer {{ size = {}; align = {}; signed = {}; {} }}", size, alignment, is_signed ? 1 : 0,
                       rest);
  }

  RandomField random_integer() {
    if (below(6) == 0) {  // a bit field
      const auto size = static_cast<std::uint32_t>(1 + below(40));
      return {integer(size, 1, below(2) == 0) + " @;", 1,
              [this, size](BitWriter& out) { out.number(random_(), size); }};
    }
    const std::uint32_t size = 8U << below(4);
    const std::uint32_t alignment = number_alignment(size);
    const bool is_signed = below(2) == 0;
    return {integer(size, alignment, is_signed, below(2) == 0 ? "base = 16;" : "") + " @;", alignment,
            [this, size, alignment](BitWriter& out) {
              out.align(alignment);
              out.number(random_(), size);
            }};
  }

  RandomField random_real() {
    const bool is_double = below(2) == 0;
    const std::uint32_t size = is_double ? 64 : 32;
    const std::uint32_t alignment = number_alignment(size);
    return {fmt::format("floating_point {{ exp_dig = {}; mant_dig = {}; align = {}; }} @;", is_double ? 11 : 8,
                        is_double ? 53 : 24, alignment),
            alignment, [this, is_double, size, alignment](BitWriter& out) {
              const double value = static_cast<double>(below(1'000'000)) / 7 - 70'000;
              out.align(alignment);
              out.number(is_double ? std::bit_cast<std::uint64_t>(value)
                                   : std::bit_cast<std::uint32_t>(static_cast<float>(value)),
                         size);
            }};
  }

  RandomField random_string() {
    return {"string @;", 8, [this](BitWriter& out) {
              out.align(8);
              out.text(std::string(below(20), static_cast<char>('a' + below(26))));
            }};
  }

  // Characters, as many as the field before says.
  RandomField random_text_sequence() {
    const std::uint32_t alignment = number_alignment(16);
    const std::size_t name = lengths_++;
    return {fmt::format("{} __length{};\n{} @[ __length{} ];", integer_text(16), name,
                        integer(8, 8, true, "encoding = UTF8;"), name),
            alignment, [this, alignment](BitWriter& out) {
              const std::uint64_t length = below(12);
              out.align(alignment);
              out.number(length, 16);
              for (std::uint64_t i = 0; i < length; ++i) {
                out.number('a' + below(26), 8);
              }
            }};
  }

  RandomField random_text_array() {
    const std::uint64_t length = 1 + below(17);
    return {integer(8, 8, true, "encoding = UTF8;") + fmt::format(" @[{}];", length), 8,
            [this, length](BitWriter& out) {
              out.align(8);
              const std::uint64_t used = below(length + 1);
              for (std::uint64_t i = 0; i < length; ++i) {
                out.number(i < used ? 'x' : 0, 8);
              }
            }};
  }

  RandomField random_enumeration() {
    const std::uint32_t size = 8U << below(3);
    return {fmt::format("enum : {} {{ \"A\" = 0, B = 1 ... 3, \"c d\" = 7 }} @;", integer_text(size)),
            number_alignment(size), [this, size, alignment = number_alignment(size)](BitWriter& out) {
              out.align(alignment);
              out.number(below(9), size);
            }};
  }
  std::string integer_text(std::uint32_t size) const {
    return fmt::format("integer {{ size = {}; align = {}; signed = 0; }}", size, number_alignment(size));
  }

  RandomField random_array(int depth) {
    RandomField element = random_field(depth - 1, false);
    const std::uint64_t length = below(5);
    name_it(element.declaration, fmt::format("@[{}]", length));
    element.write = [length, alignment = element.alignment, each = element.write](BitWriter& out) {
      out.align(alignment);  // also when there are no elements
      for (std::uint64_t i = 0; i < length; ++i) {
        each(out);
      }
    };
    return element;
  }

  // A field before it holds its length.
  RandomField random_sequence(int depth) {
    if (below(3) == 0) {
      return random_text_sequence();
    }
    RandomField element = random_field(depth - 1, false);
    const std::uint32_t alignment = number_alignment(32);
    name_it(element.declaration, fmt::format("@[ __length{} ]", lengths_));
    element.declaration = fmt::format("{} __length{};\n{}", integer_text(32), lengths_++, element.declaration);
    element.write = [this, alignment, of_elements = element.alignment, each = element.write](BitWriter& out) {
      const std::uint64_t length = below(6);
      out.align(alignment);
      out.number(length, 32);
      out.align(of_elements);
      for (std::uint64_t i = 0; i < length; ++i) {
        each(out);
      }
    };
    element.alignment = std::max(element.alignment, alignment);
    return element;
  }

  RandomField random_variant(int depth) {
    std::vector<RandomField> options;
    for (std::uint64_t i = 0, count = 2 + below(2); i < count; ++i) {
      options.push_back(random_field(depth - 1, false));
    }
    const std::uint32_t size = 8;
    std::string labels;
    std::string declarations;
    for (std::size_t i = 0; i < options.size(); ++i) {
      labels += fmt::format("{}\"option{}\" = {}", i == 0 ? "" : ", ", i, i);
      std::string declaration = options[i].declaration;
      name_it(declaration, fmt::format("option{}", i));
      declarations += declaration;
    }
    const std::size_t tag = lengths_++;
    return {fmt::format("enum : {} {{ {} }} _tag{};\nvariant <_tag{}> {{ {} }} @;", integer_text(size), labels, tag,
                        tag, declarations),
            8, [this, options](BitWriter& out) {
              const std::size_t chosen = below(options.size());
              out.align(8);
              out.number(chosen, size);
              options[chosen].write(out);
            }};
  }

  RandomField random_structure(int depth) {
    const RandomField inside = structure(depth - 1);
    return {fmt::format("struct {{ {} }} @;", inside.declaration), inside.alignment, inside.write};
  }

  // Contexts that LTTng records, which readers look at for each event.
  RandomField usual_contexts() {
    return {integer(32, 8, true) + " _vpid;" + integer(32, 8, true) + " _vtid;" +
                integer(8, 8, true, "encoding = UTF8;") + " _procname[17];",
            8, [this](BitWriter& out) {
              out.align(8);
              out.number(below(1000), 32);
              out.number(random_(), 32);
              const std::uint64_t used = below(16);
              for (std::uint64_t i = 0; i < 17; ++i) {
                out.number(i < used ? 'n' : 0, 8);
              }
            }};
  }

  static void name_it(std::string& declaration, const std::string& name) {
    declaration.replace(declaration.rfind('@'), 1, name);
  }

  // A type that needs a field before it can't be an element or an option.
  RandomField random_field(int depth, bool as_member) {
    const std::uint64_t kinds = depth > 0 ? 10 : 6;
    for (;;) {
      const std::uint64_t kind = below(kinds);
      if (kind <= 1) {
        return random_integer();
      }
      if (kind == 2) {
        return random_real();
      }
      if (kind == 3) {
        return random_string();
      }
      if (kind == 5) {
        return random_enumeration();
      }
      if (kind == 9) {
        return random_structure(depth);
      }
      if (!as_member) {
        continue;
      }
      if (kind == 4) {
        return random_text_array();
      }
      if (kind == 6) {
        return random_array(depth);
      }
      if (kind == 7) {
        return random_sequence(depth);
      }
      return random_variant(depth);
    }
  }

  // The members of a structure.
  RandomField structure(int depth) {
    std::vector<RandomField> members;
    std::string declaration;
    std::uint32_t alignment = 1;
    const std::uint64_t count = below(6);
    for (std::uint64_t i = 0; i < count; ++i) {
      members.push_back(random_field(depth, true));
      std::string member = members.back().declaration;
      name_it(member, fmt::format("_field{}", i));
      declaration += member + "\n";
      alignment = std::max(alignment, members.back().alignment);
    }
    return {declaration, alignment, [members, alignment](BitWriter& out) {
              out.align(alignment);
              for (const RandomField& member : members) {
                member.write(out);
              }
            }};
  }

  struct RandomEvent {
    std::optional<RandomField> context;  // of this event alone
    RandomField fields;
  };

  RandomEvent random_event() {
    RandomEvent event;
    // libbabeltrace2 2.0.4 ends the program (Assertion `tgt_fc` failed) at a sequence or a variant in such a context.
    if (below(4) == 0) {
      event.context = structure(0);
    }
    event.fields = structure(3);
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
  bool big_endian_ = false;
  bool natural_ = false;
  bool compact_ = false;
  bool contexts_ = false;
  std::uint32_t clock_bits_ = 0;
  std::size_t lengths_ = 0;
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
