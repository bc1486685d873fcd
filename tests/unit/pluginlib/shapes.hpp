// SPDX-License-Identifier: Apache-2.0
// The base class of the plugins in these tests.
#pragma once

#include <string>

namespace shapes {

class Shape {
 public:
  virtual ~Shape() = default;
  virtual std::string name() const = 0;
};

// Another base class of the same library.
class Colour {
 public:
  virtual ~Colour() = default;
  virtual int hue() const = 0;
};

}  // namespace shapes
