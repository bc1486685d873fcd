// SPDX-License-Identifier: Apache-2.0
#include "tracing/decode/ctf/trace_class.hpp"

namespace tracing::ctf {
namespace {

__extension__ using Wide = __int128;  // cycles times nanoseconds

}  // namespace

std::int64_t Clock::nanoseconds(std::uint64_t cycles) const {
  constexpr std::int64_t kSecond = 1'000'000'000;
  const auto total = static_cast<Wide>(cycles) + offset;
  const auto fraction = frequency == kSecond ? total : total * kSecond / static_cast<Wide>(frequency);
  return static_cast<std::int64_t>(fraction + static_cast<Wide>(offset_s) * kSecond);
}

std::optional<std::int64_t> TraceClass::environment_number(const std::string& name) const {
  const auto found = environment.find(name);
  if (found == environment.end()) {
    return std::nullopt;
  }
  const auto* const number = std::get_if<std::int64_t>(&found->second);
  return number ? std::optional(*number) : std::nullopt;
}

std::string_view environment_text(const Environment& environment, const std::string& name) {
  const auto found = environment.find(name);
  const auto* const text = found == environment.end() ? nullptr : std::get_if<std::string>(&found->second);
  return text == nullptr ? std::string_view() : *text;
}

}  // namespace tracing::ctf
