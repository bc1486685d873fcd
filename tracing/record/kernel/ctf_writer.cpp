// SPDX-License-Identifier: Apache-2.0
#include "tracing/record/kernel/ctf_writer.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <ctime>
#include <fstream>
#include <random>
#include <system_error>

#include "tracing/record/kernel/ring_page.hpp"

namespace tracing::kernel {
namespace {

namespace fs = std::filesystem;

constexpr std::uint32_t kMagic = 0xC1FC1FC1;
constexpr std::size_t kMetadataHeader = 37;  // bytes of a packet of metadata before its text (CTF 1.8, 7.1)
constexpr std::uint32_t kMetadataMagic = 0x75D11D57;

template <typename T>
void append(std::string& bytes, T value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

std::string as_text(const TraceUuid& uuid) {
  std::string text;
  for (std::size_t i = 0; i < uuid.size(); ++i) {
    text += fmt::format("{}{:02x}", i == 4 || i == 6 || i == 8 || i == 10 ? "-" : "", uuid[i]);
  }
  return text;
}

std::string host_name() {
  std::array<char, 256> name{};
  gethostname(name.data(), name.size() - 1);
  return name.data();
}

void write(const fs::path& path, const std::string& bytes, std::ios::openmode mode) {
  std::ofstream file(path, std::ios::binary | mode);
  file << bytes << std::flush;
  if (!file) {
    throw std::system_error(errno, std::generic_category(), path.string());
  }
}

// The text of a metadata file: the content of its packets, or the file itself when it has none.
std::string metadata_text(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  const std::string bytes((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  std::string text;
  for (std::size_t at = 0; at + kMetadataHeader <= bytes.size();) {
    std::uint32_t magic = 0;
    std::uint32_t content_bits = 0;
    std::uint32_t packet_bits = 0;
    std::memcpy(&magic, bytes.data() + at, sizeof magic);
    std::memcpy(&content_bits, bytes.data() + at + 24, sizeof content_bits);
    std::memcpy(&packet_bits, bytes.data() + at + 28, sizeof packet_bits);
    if (magic != kMetadataMagic || packet_bits / 8 < kMetadataHeader || content_bits / 8 < kMetadataHeader) {
      break;
    }
    text += bytes.substr(at + kMetadataHeader, content_bits / 8 - kMetadataHeader);
    at += packet_bits / 8;
  }
  return text.empty() ? bytes : text;
}

std::string after(const std::string& text, const std::string& key, std::size_t from) {
  const std::size_t found = text.find(key, from);
  if (found == std::string::npos) {
    return {};
  }
  const std::size_t begin = found + key.size();
  return text.substr(begin, text.find(';', begin) - begin);
}

std::string integer(std::uint32_t bytes, bool is_signed, bool hexadecimal) {
  return fmt::format("integer {{ size = {}; align = 8; signed = {}; encoding = none; base = {}; }}", bytes * 8,
                     is_signed ? 1 : 0, hexadecimal ? 16 : 10);
}

std::string describe(const EventField& field) {
  switch (field.kind) {
    case EventField::Kind::kInteger:
      return fmt::format("\t\t{} _{};\n", integer(field.size, field.is_signed, field.hexadecimal), field.name);
    case EventField::Kind::kText:
      return fmt::format("\t\tinteger {{ size = 8; align = 8; signed = 0; encoding = UTF8; }} _{}[{}];\n", field.name,
                         field.size);
    case EventField::Kind::kDynamicText:
      return fmt::format("\t\tstring _{};\n", field.name);
    case EventField::Kind::kIntegers:
      return fmt::format("\t\t{} _{}[{}];\n", integer(field.element_size, field.is_signed, false), field.name,
                         field.size / field.element_size);
  }
  return {};
}

void append_field(std::string& packet, const EventField& field, std::span<const std::uint8_t> record) {
  if (field.kind == EventField::Kind::kDynamicText) {
    std::uint32_t place = 0;
    if (field.offset + sizeof place <= record.size()) {
      std::memcpy(&place, record.data() + field.offset, sizeof place);
    }
    const std::size_t begin = place & 0xFFFF;
    const std::size_t length = place >> 16;
    if (begin + length <= record.size()) {
      const char* const text = reinterpret_cast<const char*>(record.data() + begin);
      packet.append(text, strnlen(text, length));
    }
    packet.push_back('\0');
    return;
  }
  const std::size_t present =
      field.offset < record.size() ? std::min<std::size_t>(field.size, record.size() - field.offset) : 0;
  packet.append(reinterpret_cast<const char*>(record.data()) + field.offset, present);
  packet.append(field.size - present, '\0');
}

}  // namespace

TraceClock clock_beside(const fs::path& directory) {
  std::error_code none;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(directory, none)) {
    if (entry.path().filename() != "metadata") {
      continue;
    }
    const std::string text = metadata_text(entry.path());
    const std::size_t clock = text.find("clock {");
    const std::string uuid = after(text, "uuid = \"", clock);
    const std::string offset = after(text, "offset = ", clock);
    if (clock == std::string::npos || uuid.empty() || offset.empty()) {
      continue;
    }
    return {.uuid = uuid.substr(0, uuid.find('"')), .offset = std::stoll(offset)};
  }
  timespec monotonic{};
  timespec real{};
  clock_gettime(CLOCK_MONOTONIC, &monotonic);
  clock_gettime(CLOCK_REALTIME, &real);
  return {.uuid = as_text(random_uuid()),
          .offset = (real.tv_sec - monotonic.tv_sec) * std::int64_t{1'000'000'000} + real.tv_nsec - monotonic.tv_nsec};
}

TraceUuid random_uuid() {
  TraceUuid uuid{};
  std::random_device random;
  for (std::uint8_t& byte : uuid) {
    byte = static_cast<std::uint8_t>(random());
  }
  return uuid;
}

CtfWriter::CtfWriter(fs::path directory, const TraceUuid& uuid, const std::vector<EventFormat>& formats,
                     const std::vector<std::string>& context_fields, ThreadTable& threads)
    : directory_(std::move(directory)), context_fields_(context_fields), threads_(threads), uuid_(uuid) {
  const auto given = [this](const char* field) {
    return std::find(context_fields_.begin(), context_fields_.end(), field) != context_fields_.end();
  };
  if (!given("tid") && !given("vtid")) {
    context_fields_.emplace_back("tid");
  }
  for (const EventFormat& format : formats) {
    formats_.emplace(format.id, format);
  }
}

void CtfWriter::append_context(std::string& packet, unsigned cpu, std::uint64_t time, std::int32_t thread) const {
  Thread who = threads_.find(thread, time);
  if (thread == 0) {
    who = {.process = 0, .name = fmt::format("swapper/{}", cpu)};  // the idle thread of each processor
  }
  for (const std::string& field : context_fields_) {
    if (field == "procname") {
      packet.append(who.name.c_str(), who.name.size() + 1);
    } else {
      append(packet, field.ends_with("pid") ? who.process : thread);
    }
  }
}

void CtfWriter::append_record(std::string& packet, unsigned cpu, std::uint64_t time,
                              std::span<const std::uint8_t> record) {
  std::uint16_t id = 0;
  std::int32_t thread = 0;
  if (record.size() < kPidOffset + sizeof thread) {
    return;
  }
  std::memcpy(&id, record.data(), sizeof id);
  std::memcpy(&thread, record.data() + kPidOffset, sizeof thread);
  const auto format = formats_.find(id);
  if (format == formats_.end()) {
    return;
  }
  append(packet, id);
  append(packet, time);
  append_context(packet, cpu, time, thread);
  for (const EventField& field : format->second.fields) {
    append_field(packet, field, record);
  }
  ++events_;
}

CtfWriter::Content CtfWriter::content_of(unsigned cpu, std::span<const std::uint8_t> page) {
  Content content;
  content.page = read_ring_page(page, [&](std::uint64_t time, std::span<const std::uint8_t> record) {
    append_record(content.events, cpu, time, record);
  });
  streams_[cpu].discarded += content.page.lost_records;
  lost_events_ += content.page.lost_records;
  return content;
}

void CtfWriter::write_page(unsigned cpu, std::span<const std::uint8_t> page) {
  const Content content = content_of(cpu, page);
  if (content.events.empty() && content.page.lost_records == 0) {
    return;
  }
  write_packet(cpu, packet_of(cpu, streams_[cpu].packets++, content));
}

std::string CtfWriter::packet_of(unsigned cpu, std::uint64_t number, std::span<const std::uint8_t> page) {
  return packet_of(cpu, number, content_of(cpu, page));
}

void CtfWriter::write_packet(unsigned cpu, const std::string& packet) {
  bytes_ += packet.size();
  write(directory_ / fmt::format("kernel_{}", cpu), packet, std::ios::app);
}

std::string CtfWriter::packet_of(unsigned cpu, std::uint64_t number, const Content& content) const {
  std::string packet;
  append(packet, kMagic);
  packet.append(reinterpret_cast<const char*>(uuid_.data()), uuid_.size());
  append(packet, std::uint32_t{0});  // stream id
  append(packet, std::uint64_t{cpu});
  append(packet, content.page.begin);
  append(packet, content.page.end);
  const std::uint64_t bits =
      (packet.size() + 4 * sizeof(std::uint64_t) + sizeof(std::uint32_t) + content.events.size()) * 8;
  append(packet, bits);  // content
  append(packet, bits);  // packet
  append(packet, number);
  append(packet, streams_.at(cpu).discarded);
  append(packet, std::uint32_t{cpu});
  packet += content.events;
  return packet;
}

void CtfWriter::write_metadata(const TraceClock& clock) const {
  std::string events;
  for (const auto& [id, format] : formats_) {
    std::string fields;
    for (const EventField& field : format.fields) {
      fields += describe(field);
    }
    events +=
        fmt::format("event {{\n\tname = \"{}\";\n\tid = {};\n\tstream_id = 0;\n\tfields := struct {{\n{}\t}};\n}};\n\n",
                    format.name, id, fields);
  }
  std::string context;
  for (const std::string& field : context_fields_) {
    context += field == "procname" ? "\t\tstring _procname;\n"
                                   : fmt::format("\t\tinteger {{ size = 32; align = 8; signed = 1; }} _{};\n", field);
  }
  write(directory_ / "metadata",
        fmt::format(R"(/* CTF 1.8 */

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
		integer {{ size = 8; align = 8; signed = false; }} uuid[16];
		uint32_t stream_id;
		uint64_t stream_instance_id;
	}};
}};

env {{
	hostname = "{host}";
	domain = "kernel";
	tracer_name = "tracefs";
}};

clock {{
	name = "monotonic";
	uuid = "{clock}";
	description = "Monotonic Clock";
	absolute = TRUE;
	freq = 1000000000;
	offset = {offset};
}};

typealias integer {{ size = 64; align = 8; signed = false; map = clock.monotonic.value; }} := clock_t;

stream {{
	id = 0;
	packet.context := struct {{
		clock_t timestamp_begin;
		clock_t timestamp_end;
		uint64_t content_size;
		uint64_t packet_size;
		uint64_t packet_seq_num;
		uint64_t events_discarded;
		uint32_t cpu_id;
	}};
	event.header := struct {{
		uint16_t id;
		clock_t timestamp;
	}};
	event.context := struct {{
{context}	}};
}};

{events})",
                    fmt::arg("uuid", as_text(uuid_)), fmt::arg("host", host_name()), fmt::arg("clock", clock.uuid),
                    fmt::arg("offset", clock.offset), fmt::arg("context", context), fmt::arg("events", events)),
        std::ios::trunc);
}

}  // namespace tracing::kernel
