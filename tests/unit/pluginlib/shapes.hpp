// SPDX-License-Identifier: Apache-2.0
// The base class of the plugins in these tests.
#pragma once

#include <class_loader/interface_traits.hpp>
#include <memory>
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

// A base class whose plugins are created with arguments.
class Drawing {
 public:
  virtual ~Drawing() = default;
  virtual std::string text() const = 0;
};

}  // namespace shapes

template <>
struct class_loader::InterfaceTraits<shapes::Drawing> {
  using constructor_parameters = class_loader::ConstructorParameters<std::string, std::unique_ptr<int>>;
};
