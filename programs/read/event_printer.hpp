// SPDX-License-Identifier: Apache-2.0
// Writes events and losses as text, as lines of JSON or as CSV.
#pragma once

#include <fmt/format.h>

#include <cstdio>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "tracing/decode/reader/event.hpp"

namespace tracing {

// Thrown when the output can't be written: the reader of a pipe has gone, the disk is full.
struct OutputClosed {
  int error = 0;  // as in errno
};

// Writes the text and what `out` still holds. Throws OutputClosed.
void write_out(std::FILE* out, std::string_view text);

// A context that every format has a place for. All others are printed beside the fields.
bool has_own_place(const std::string& context);

class EventPrinter {
 public:
  explicit EventPrinter(std::FILE* out) : out_(out) {}
  virtual ~EventPrinter() = default;
  virtual void print(const Event& event) = 0;
  virtual void print(const Loss& loss) = 0;
  // Writes what is still in memory.
  void flush();

 protected:
  void end_line();
  fmt::memory_buffer line_;  // lines that are not yet written

 private:
  std::FILE* out_;
};

// `2026-01-01 00:00:00.000000000 +0.000000250 ros2:callback_start cpu 0 ping [71/71] callback=0x7f is_intra_process=0`,
// where the second number is the time since the previous event. Other contexts stand as {vppid=70} before the fields.
std::unique_ptr<EventPrinter> make_text_printer(std::FILE* out);

// {"time_ns":…,"event":"ros2:callback_start","cpu_id":0,"vpid":71,"vtid":71,"procname":"ping","fields":{…}}, with
// "contexts":{…} before the fields if there are others.
std::unique_ptr<EventPrinter> make_json_printer(std::FILE* out);

// A header line, then one line for each event: time_ns, event, cpu_id, vpid, vtid, procname, then `fields`, the names
// of all fields and other contexts of all events. Where an event has both of one name, the field counts. Losses go to
// the standard error output.
std::unique_ptr<EventPrinter> make_csv_printer(std::FILE* out, std::vector<std::string> fields);

}  // namespace tracing
