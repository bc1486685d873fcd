// SPDX-License-Identifier: Apache-2.0
// A trace with damage anywhere. Our decoder reads as far as it goes. Every value of every event is asked for.
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "tests/fuzz/trace_input.hpp"
#include "tests/support/trace_writer/temporary_directory.hpp"
#include "tracing/decode/reader/trace_reader.hpp"

namespace {

using namespace tracing;

// Keeps the compiler from leaving the values out.
volatile std::size_t sum = 0;

std::size_t sum_of(std::string_view text) {
  std::size_t sum_of_bytes = 0;
  for (const char c : text) {
    sum_of_bytes += static_cast<unsigned char>(c);
  }
  return sum_of_bytes;
}

std::size_t sum_of(const FieldValue& value) {
  std::size_t all = value.is_hexadecimal() ? 1 : 0;
  if (const auto label = value.enumeration_label()) {
    all += sum_of(*label);
  }
  if (const auto number = value.unsigned_integer()) {
    all += *number;
  }
  if (const auto number = value.integer()) {
    all += static_cast<std::size_t>(*number);
  }
  if (const auto number = value.real()) {
    all += *number > 0 ? 1 : 0;
  }
  if (const auto text = value.string()) {
    all += sum_of(*text);
  }
  for (std::size_t i = 0; i < value.size(); ++i) {
    if (value.is_structure()) {
      all += sum_of(value.member_name(i));
    }
    all += sum_of(value[i]);
  }
  return all;
}

std::size_t sum_of(const Event& event) {
  std::size_t all = sum_of(event.name()) + event.procname.value_or("").size();
  for (std::size_t i = 0; i < event.event_class->fields.size(); ++i) {
    all += sum_of(event.field(i));
  }
  for (std::size_t i = 0; i < event.event_class->contexts.size(); ++i) {
    all += sum_of(event.context(i));
  }
  return all;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const testing::TemporaryDirectory directory;
  fuzz::write_trace(directory.path(), {reinterpret_cast<const char*>(data), size});
  try {
    TraceReader reader(directory.path(), TraceReader::Decoder::kDirect);
    while (const TraceItem item = reader.next()) {
      if (item.event != nullptr) {
        sum = sum + sum_of(*item.event);
      }
      if (item.loss != nullptr) {
        sum = sum + item.loss->stream->name.size();
      }
    }
    reader.throw_damage();
  } catch (const TraceReadError& error) {
    sum = sum + sum_of(error.what());
  }
  return 0;
}
