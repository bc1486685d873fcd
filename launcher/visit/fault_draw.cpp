// SPDX-License-Identifier: Apache-2.0
#include "launcher/visit/fault_draw.hpp"

#include <cmath>

namespace launch {

namespace {

// FNV-1a.
std::uint64_t hash(std::string_view text) {
  std::uint64_t value = 0xcbf29ce484222325U;
  for (const unsigned char byte : text) {
    value = (value ^ byte) * 0x100000001b3U;
  }
  return value;
}

// A step of SplitMix64: neighbouring seeds give numbers that have nothing in common.
std::uint64_t mixed(std::uint64_t value) {
  value += 0x9e3779b97f4a7c15U;
  value = (value ^ (value >> 30U)) * 0xbf58476d1ce4e5b9U;
  value = (value ^ (value >> 27U)) * 0x94d049bb133111ebU;
  return value ^ (value >> 31U);
}

}  // namespace

double FaultDraw::share(std::string_view attribute) const {
  std::string text(attribute);
  text += '\n';
  text += identity_;
  constexpr unsigned kBitsOfDouble = 53;
  return std::ldexp(static_cast<double>(mixed(mixed(seed_) ^ hash(text)) >> (64U - kBitsOfDouble)),
                    -static_cast<int>(kBitsOfDouble));
}

double FaultDraw::number(std::string_view attribute, const NumberRange& range) const {
  if (!range.is_random()) {
    return range.from;
  }
  constexpr double kSteps = 1000;
  return std::round((range.from + share(attribute) * (range.to - range.from)) * kSteps) / kSteps;
}

std::uint64_t FaultDraw::whole(std::string_view attribute, const NumberRange& range) const {
  return static_cast<std::uint64_t>(range.from + std::floor(share(attribute) * (range.to - range.from + 1)));
}

}  // namespace launch
