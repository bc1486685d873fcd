// SPDX-License-Identifier: Apache-2.0
// Draws the random parts of a fault.
//
// A number depends on the seed of the run, on the fault and on the attribute alone, so a fault that is added to or
// taken from a test changes no number of the others.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace launch {

// A number, or a range of numbers from which one is drawn.
struct NumberRange {
  double from = 0;
  double to = 0;

  bool is_random() const { return from < to; }
};

class FaultDraw {
 public:
  // `identity` is a text that tells the fault from the others of its test.
  FaultDraw(std::uint64_t seed, std::string identity) : seed_(seed), identity_(std::move(identity)) {}

  // Evenly distributed, from 0 to less than 1.
  double share(std::string_view attribute) const;
  // Of the range, rounded to a thousandth.
  double number(std::string_view attribute, const NumberRange& range) const;
  // A whole number of the range, whose ends are whole.
  std::uint64_t whole(std::string_view attribute, const NumberRange& range) const;

 private:
  std::uint64_t seed_;
  std::string identity_;
};

}  // namespace launch
