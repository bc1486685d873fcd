// SPDX-License-Identifier: Apache-2.0
#include "tests/support/trace_writer/trace_writer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <type_traits>
#include <utility>

namespace tracing::testing {

using detail::append;

namespace {

constexpr std::uint32_t kMagic = 0xC1FC1FC1;
constexpr std::size_t kUuidSize = 16;
constexpr std::size_t kPacketHeaderSize = 4 + kUuidSize + 4 + 8 + 5 * 8 + 8 + 4;
constexpr std::size_t kProcnameSize = 17;

std::string uuid(std::uint8_t identity) {
  return fmt::format("11111111-1111-1111-1111-1111111111{:02x}", identity);
}

}  // namespace

std::string detail::describe_field(ros2::FieldType type, std::string_view name) {
  const auto integer = [](int size, bool is_signed, int base) {
    return fmt::format("integer {{ size = {}; align = 8; signed = {}; encoding = none; base = {}; }}", size,
                       is_signed ? 1 : 0, base);
  };
  switch (type) {
    case ros2::FieldType::kPointer:
      return fmt::format("\t\t{} _{};\n", integer(64, false, 16), name);
    case ros2::FieldType::kString:
      return fmt::format("\t\tstring _{};\n", name);
    case ros2::FieldType::kUint64:
      return fmt::format("\t\t{} _{};\n", integer(64, false, 10), name);
    case ros2::FieldType::kInt64:
      return fmt::format("\t\t{} _{};\n", integer(64, true, 10), name);
    case ros2::FieldType::kBool:
      return fmt::format("\t\t{} _{};\n", integer(32, true, 10), name);
    case ros2::FieldType::kReal:
      return fmt::format("\t\tfloating_point {{ exp_dig = 11; mant_dig = 53; align = 8; }} _{};\n", name);
    case ros2::FieldType::kGid:
      return fmt::format("\t\t{} _{}[16];\n", integer(8, false, 10), name);
    case ros2::FieldType::kPointers:
      return fmt::format("\t\t{0} __{1}_length;\n\t\t{2} _{1}[ __{1}_length ];\n", integer(64, false, 10), name,
                         integer(64, false, 16));
  }
  return "";
}

TraceWriter::TraceWriter(const std::filesystem::path& directory) : TraceWriter(directory, Options()) {}

TraceWriter::TraceWriter(const std::filesystem::path& directory, Options options)
    : directory_(directory), options_(options) {
  std::filesystem::create_directories(directory_);
}

void TraceWriter::write(unsigned cpu, std::int64_t time_ns, const Thread& thread, const ros2::AnyEvent& event) {
  std::visit(
      [&]<class Struct>(const Struct& known) {
        if constexpr (!std::is_same_v<Struct, std::monostate>) {
          write(cpu, time_ns, thread, known);
        }
      },
      event);
}

std::uint16_t TraceWriter::declare(std::string_view name, const std::string& fields) {
  const auto id = static_cast<std::uint16_t>(ids_.size());
  ids_.emplace(name, id);
  event_descriptions_ += fmt::format(
      "event {{\n\tname = \"{}\";\n\tid = {};\n\tstream_id = 0;\n\tloglevel = 13;\n\tfields := struct "
      "{{\n{}\t}};\n}};\n\n",
      name, id, fields);
  return id;
}

void TraceWriter::write_raw(unsigned cpu, std::int64_t time_ns, const Thread& thread, std::uint16_t id,
                            std::string_view payload) {
  Cpu& stream = cpus_[cpu];
  if (stream.events.empty()) {
    stream.begin_ns = time_ns;
  }
  stream.end_ns = time_ns;
  append(stream.events, id);
  append(stream.events, static_cast<std::uint64_t>(time_ns));
  if (options_.contexts) {
    append(stream.events, static_cast<std::int32_t>(thread.vpid));
    append(stream.events, static_cast<std::int32_t>(thread.vtid));
    const std::string_view name = thread.procname.substr(0, kProcnameSize - 2);
    stream.events.append(name);
    stream.events.append(kProcnameSize - name.size(), '\0');
    if (options_.vppid) {
      append(stream.events, *options_.vppid);
    }
    if (options_.pid_ns) {
      append(stream.events, thread.pid_ns);
    }
  }
  stream.events.append(payload);
  if (stream.events.size() > options_.packet_size) {
    end_packet(cpu);
  }
}

void TraceWriter::end_packet(unsigned cpu) {
  Cpu& stream = cpus_[cpu];
  std::string packet;
  append(packet, kMagic);
  packet.append(kUuidSize - 1, '\x11');
  append(packet, options_.identity);
  append(packet, std::uint32_t{0});  // stream id
  append(packet, std::uint64_t{cpu});
  const std::uint64_t bits = (kPacketHeaderSize + stream.events.size()) * 8;
  append(packet, static_cast<std::uint64_t>(stream.begin_ns));
  append(packet, static_cast<std::uint64_t>(stream.end_ns));
  append(packet, bits);
  append(packet, bits);
  append(packet, stream.sequence_number++);
  append(packet, std::exchange(stream.hides_discarded, false) ? std::uint64_t{0} : stream.discarded);
  append(packet, std::uint32_t{cpu});
  packet += stream.events;
  std::ofstream(directory_ / fmt::format("ros2_{}", cpu), std::ios::binary | std::ios::app) << packet;
  stream.events.clear();
  stream.begin_ns = stream.end_ns;
}

void TraceWriter::hide_discarded_events(unsigned cpu) {
  cpus_[cpu].hides_discarded = true;
}

void TraceWriter::discard_events(unsigned cpu, std::uint32_t count) {
  cpus_[cpu].discarded += count;
}

void TraceWriter::lose_packets(unsigned cpu, std::uint64_t count) {
  cpus_[cpu].sequence_number += count;
}

void TraceWriter::finish() {
  for (auto& [cpu, stream] : cpus_) {
    if (!stream.events.empty()) {
      end_packet(cpu);
    }
  }
  std::ofstream(directory_ / "metadata") << metadata();
}

std::string TraceWriter::metadata() const {
  const std::string context =
      options_.contexts
          ? fmt::format(
                "\tevent.context := struct {{\n"
                "\t\tinteger {{ size = 32; align = 8; signed = 1; }} _vpid;\n"
                "\t\tinteger {{ size = 32; align = 8; signed = 1; }} _vtid;\n"
                "\t\tinteger {{ size = 8; align = 8; signed = 0; encoding = UTF8; }} _procname[{}];\n{}{}\t}};\n",
                kProcnameSize, options_.vppid ? "\t\tinteger { size = 32; align = 8; signed = 1; } _vppid;\n" : "",
                options_.pid_ns ? "\t\tinteger { size = 32; align = 8; signed = 0; } _pid_ns;\n" : "")
          : "";
  const std::string process =
      options_.per_process_vpid ? fmt::format("\tvpid = {};\n\tprocname = \"p\";\n", *options_.per_process_vpid) : "";
  return fmt::format(R"(/* CTF 1.8 */

typealias integer {{ size = 8; align = 8; signed = false; }} := uint8_t;
typealias integer {{ size = 16; align = 8; signed = false; }} := uint16_t;
typealias integer {{ size = 32; align = 8; signed = false; }} := uint32_t;
typealias integer {{ size = 64; align = 8; signed = false; }} := uint64_t;

trace {{
	major = 1;
	minor = 8;
	uuid = "{uuid}";
	byte_order = le;
	packet.header := struct {{
		uint32_t magic;
		uint8_t  uuid[16];
		uint32_t stream_id;
		uint64_t stream_instance_id;
	}};
}};

env {{
	hostname = "box";
	domain = "ust";
	tracer_name = "lttng-ust";
	tracer_major = 2;
	tracer_minor = 13;
{process}}};

clock {{
	name = "monotonic";
	uuid = "22222222-2222-2222-2222-222222222222";
	freq = 1000000000;
	offset = 0;
}};

typealias integer {{ size = 64; align = 8; signed = false; map = clock.monotonic.value; }} := clock_t;

struct packet_context {{
	clock_t timestamp_begin;
	clock_t timestamp_end;
	uint64_t content_size;
	uint64_t packet_size;
	uint64_t packet_seq_num;
	uint64_t events_discarded;
	uint32_t cpu_id;
}};

struct event_header_large {{
	enum : uint16_t {{ compact = 0 ... 65534, extended = 65535 }} id;
	variant <id> {{
		struct {{ clock_t timestamp; }} compact;
		struct {{ uint32_t id; clock_t timestamp; }} extended;
	}} v;
}} align(8);

stream {{
	id = 0;
	event.header := struct event_header_large;
	packet.context := struct packet_context;
{context}}};

{events})",
                     fmt::arg("uuid", uuid(options_.identity)), fmt::arg("process", process),
                     fmt::arg("context", context), fmt::arg("events", event_descriptions_));
}

}  // namespace tracing::testing
