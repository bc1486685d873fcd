// SPDX-License-Identifier: Apache-2.0
#include "base/processes/process_stat.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <optional>
#include <string_view>

#include "base/files/small_file.hpp"

namespace launch {
namespace {

// The fields behind the name, one after the other.
class Fields {
 public:
  explicit Fields(std::string_view text) : rest_(text) {}

  std::string_view next() {
    rest_.remove_prefix(std::min(rest_.find_first_not_of(' '), rest_.size()));
    const std::string_view field = rest_.substr(0, rest_.find_first_of(" \n"));
    rest_.remove_prefix(field.size());
    return field;
  }

  template <typename Number>
  Number number() {
    const std::string_view field = next();
    Number value = 0;
    std::from_chars(field.data(), field.data() + field.size(), value);
    return value;
  }

  void skip(int count) {
    for (int i = 0; i < count; ++i) {
      next();
    }
  }

 private:
  std::string_view rest_;
};

}  // namespace

// "pid (name) state parent … started …", and the name may have brackets in it.
ProcessStat read_process_stat(pid_t pid) {
  constexpr int kBetweenParentAndTimes = 9;
  constexpr int kBetweenTimesAndStart = 6;
  const std::optional<std::string> text = read_small_file(fmt::format("/proc/{}/stat", pid));
  if (!text) {
    return {};
  }
  const std::size_t open = text->find('(');
  const std::size_t close = text->rfind(')');
  if (open == std::string::npos || close == std::string::npos || close + 4 >= text->size()) {
    return {};
  }
  ProcessStat process{.name = text->substr(open + 1, close - open - 1)};
  Fields fields(std::string_view(*text).substr(close + 1));
  process.state = fields.next().front();
  process.parent = fields.number<pid_t>();
  fields.skip(kBetweenParentAndTimes);
  process.processor_time = fields.number<std::uint64_t>();
  process.processor_time += fields.number<std::uint64_t>();
  fields.skip(kBetweenTimesAndStart);
  process.started = fields.number<std::uint64_t>();
  return process;
}

}  // namespace launch
