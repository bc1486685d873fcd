// SPDX-License-Identifier: Apache-2.0
#include "programs/read/event_printer.hpp"

#include <fmt/chrono.h>

#include <algorithm>
#include <cerrno>
#include <ctime>
#include <filesystem>
#include <iterator>
#include <string_view>
#include <unordered_map>
#include <utility>

#include "programs/read/value_text.hpp"

namespace tracing {
namespace {

constexpr std::int64_t kSecond = 1'000'000'000;
constexpr std::size_t kWriteAt = 1 << 16;  // bytes

// All contexts but those that have a place of their own. `separator` stands between them.
template <class AppendOne>
void append_contexts(Buffer& out, const Event& event, char separator, AppendOne append_one) {
  const std::vector<std::string>& names = event.event_class->contexts;
  bool is_first = true;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (has_own_place(names[i])) {
      continue;
    }
    if (!is_first) {
      out.push_back(separator);
    }
    is_first = false;
    append_one(names[i], event.context(i));
  }
}

bool has_contexts(const Event& event) {
  const std::vector<std::string>& names = event.event_class->contexts;
  return !std::all_of(names.begin(), names.end(), has_own_place);
}

const char* lost_what(const Loss& loss) {
  return loss.kind == Loss::Kind::kEvents ? "events" : "packets";
}

std::string stream_name(const Loss& loss) {
  return std::filesystem::path(loss.stream->name).filename();
}

class TextPrinter : public EventPrinter {
 public:
  using EventPrinter::EventPrinter;

  void print(const Event& event) override {
    append_time(event.timestamp_ns);
    const std::int64_t since = last_ns_ ? event.timestamp_ns - *last_ns_ : 0;
    last_ns_ = event.timestamp_ns;
    fmt::format_to(std::back_inserter(line_), " +{}.{:09} {}", since / kSecond, since % kSecond, event.name());
    if (event.cpu_id) {
      fmt::format_to(std::back_inserter(line_), " cpu {}", *event.cpu_id);
    }
    if (event.procname) {
      fmt::format_to(std::back_inserter(line_), " {}", *event.procname);
    }
    if (event.vpid) {
      fmt::format_to(std::back_inserter(line_), " [{}", *event.vpid);
      if (event.vtid) {
        fmt::format_to(std::back_inserter(line_), "/{}", *event.vtid);
      }
      line_.push_back(']');
    }
    if (has_contexts(event)) {
      append(line_, " {");
      append_contexts(line_, event, ' ', [this](std::string_view name, const FieldValue& value) {
        append(line_, name);
        line_.push_back('=');
        append_text(line_, value);
      });
      line_.push_back('}');
    }
    const std::vector<std::string>& fields = event.event_class->fields;
    for (std::size_t i = 0; i < fields.size(); ++i) {
      line_.push_back(' ');
      append(line_, fields[i]);
      line_.push_back('=');
      append_text(line_, event.field(i));
    }
    end_line();
  }

  void print(const Loss& loss) override {
    append_time(loss.begin_ns.value_or(0));
    const std::string count = loss.count ? std::to_string(*loss.count) : "an unknown number of";
    fmt::format_to(std::back_inserter(line_), " LOST {} {} of {}", count, lost_what(loss), stream_name(loss));
    if (loss.begin_ns && loss.end_ns) {
      const std::int64_t took = *loss.end_ns - *loss.begin_ns;
      fmt::format_to(std::back_inserter(line_), ", within {}.{:09} s", took / kSecond, took % kSecond);
    }
    end_line();
  }

 private:
  // The date is formatted once a second.
  void append_time(std::int64_t ns) {
    const std::int64_t second = ns / kSecond - (ns % kSecond < 0 ? 1 : 0);
    if (second != second_ || date_.empty()) {
      second_ = second;
      date_ = fmt::format("{:%Y-%m-%d %H:%M:%S}", fmt::gmtime(static_cast<std::time_t>(second)));
    }
    fmt::format_to(std::back_inserter(line_), "{}.{:09}", date_, ns - second * kSecond);
  }

  std::optional<std::int64_t> last_ns_;
  std::int64_t second_ = 0;
  std::string date_;
};

class JsonPrinter : public EventPrinter {
 public:
  using EventPrinter::EventPrinter;

  void print(const Event& event) override {
    fmt::format_to(std::back_inserter(line_), R"({{"time_ns":{},"event":)", event.timestamp_ns);
    append_quoted(line_, event.name());
    if (event.cpu_id) {
      fmt::format_to(std::back_inserter(line_), R"(,"cpu_id":{})", *event.cpu_id);
    }
    if (event.vpid) {
      fmt::format_to(std::back_inserter(line_), R"(,"vpid":{})", *event.vpid);
    }
    if (event.vtid) {
      fmt::format_to(std::back_inserter(line_), R"(,"vtid":{})", *event.vtid);
    }
    if (event.procname) {
      append(line_, R"(,"procname":)");
      append_quoted(line_, *event.procname);
    }
    if (has_contexts(event)) {
      append(line_, R"(,"contexts":{)");
      append_contexts(line_, event, ',', [this](std::string_view name, const FieldValue& value) {
        append_quoted(line_, name);
        line_.push_back(':');
        append_json(line_, value);
      });
      line_.push_back('}');
    }
    append(line_, R"(,"fields":{)");
    const std::vector<std::string>& fields = event.event_class->fields;
    for (std::size_t i = 0; i < fields.size(); ++i) {
      if (i > 0) {
        line_.push_back(',');
      }
      append_quoted(line_, fields[i]);
      line_.push_back(':');
      append_json(line_, event.field(i));
    }
    append(line_, "}}");
    end_line();
  }

  void print(const Loss& loss) override {
    fmt::format_to(std::back_inserter(line_), R"({{"time_ns":{},"lost":"{}","count":)", loss.begin_ns.value_or(0),
                   lost_what(loss));
    append(line_, loss.count ? std::to_string(*loss.count) : "null");
    append(line_, R"(,"end_ns":)");
    append(line_, loss.end_ns ? std::to_string(*loss.end_ns) : "null");
    append(line_, R"(,"stream":)");
    append_quoted(line_, stream_name(loss));
    line_.push_back('}');
    end_line();
  }
};

class CsvPrinter : public EventPrinter {
 public:
  CsvPrinter(std::FILE* out, std::vector<std::string> fields) : EventPrinter(out) {
    append(line_, "time_ns,event,cpu_id,vpid,vtid,procname");
    for (std::size_t i = 0; i < fields.size(); ++i) {
      columns_.emplace(fields[i], i);
      line_.push_back(',');
      append_cell(fields[i]);
    }
    end_line();
  }

  void print(const Event& event) override {
    const auto cell = [](const std::optional<std::int64_t>& number) { return number ? std::to_string(*number) : ""; };
    fmt::format_to(std::back_inserter(line_), "{},", event.timestamp_ns);
    append_cell(event.name());
    fmt::format_to(std::back_inserter(line_), ",{},{},{},", cell(event.cpu_id), cell(event.vpid), cell(event.vtid));
    append_cell(event.procname.value_or(""));
    std::vector<std::string> cells(columns_.size());
    const auto set = [&](const std::string& name, const FieldValue& value) {
      const auto column = columns_.find(name);
      if (column != columns_.end()) {
        cells[column->second] = text_of(value);
      }
    };
    const EventClass& recorded = *event.event_class;
    for (std::size_t i = 0; i < recorded.contexts.size(); ++i) {
      set(recorded.contexts[i], event.context(i));
    }
    for (std::size_t i = 0; i < recorded.fields.size(); ++i) {
      set(recorded.fields[i], event.field(i));
    }
    for (const std::string& text : cells) {
      line_.push_back(',');
      append_cell(text);
    }
    end_line();
  }

  void print(const Loss& loss) override {
    const std::string count = loss.count ? std::to_string(*loss.count) : "an unknown number of";
    // fmt::print would throw where the standard error output is closed.
    std::fputs(
        fmt::format("launch trace read: warning: {} {} of {} were lost\n", count, lost_what(loss), stream_name(loss))
            .c_str(),
        stderr);
  }

 private:
  static std::string text_of(const FieldValue& value) {
    if (const auto text = value.string()) {
      return std::string(*text);
    }
    Buffer out;
    if (is_number(value) && !value.enumeration_label()) {
      append_number(out, value, false);
    } else {
      append_text(out, value);
    }
    return fmt::to_string(out);
  }

  // RFC 4180: quotes around a cell with a comma, a quote or a line break; quotes inside are doubled.
  void append_cell(std::string_view text) {
    if (text.find_first_of(",\"\r\n") == std::string_view::npos) {
      return append(line_, text);
    }
    line_.push_back('"');
    for (const char c : text) {
      if (c == '"') {
        line_.push_back('"');
      }
      line_.push_back(c);
    }
    line_.push_back('"');
  }

  std::unordered_map<std::string, std::size_t> columns_;
};

}  // namespace

bool has_own_place(const std::string& context) {
  return context == "vpid" || context == "vtid" || context == "procname";
}

void write_out(std::FILE* out, std::string_view text) {
  errno = 0;
  if (std::fwrite(text.data(), 1, text.size(), out) != text.size() || std::fflush(out) != 0) {
    throw OutputClosed{errno};
  }
}

void EventPrinter::end_line() {
  line_.push_back('\n');
  if (line_.size() >= kWriteAt) {
    flush();
  }
}

void EventPrinter::flush() {
  const std::string_view lines(line_.data(), line_.size());
  line_.clear();  // frees nothing, and forgets the lines even if they can't be written
  write_out(out_, lines);
}

std::unique_ptr<EventPrinter> make_text_printer(std::FILE* out) {
  return std::make_unique<TextPrinter>(out);
}

std::unique_ptr<EventPrinter> make_json_printer(std::FILE* out) {
  return std::make_unique<JsonPrinter>(out);
}

std::unique_ptr<EventPrinter> make_csv_printer(std::FILE* out, std::vector<std::string> fields) {
  return std::make_unique<CsvPrinter>(out, std::move(fields));
}

}  // namespace tracing
