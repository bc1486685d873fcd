// SPDX-License-Identifier: Apache-2.0
// A library of plugins.
#include <pluginlib/class_list_macros.hpp>

#include "tests/unit/pluginlib/shapes.hpp"

namespace shapes {
namespace {

class Square : public Shape {
 public:
  std::string name() const override { return "square"; }
};

class Triangle : public Shape {
 public:
  std::string name() const override { return "triangle"; }
};

class Red : public Colour {
 public:
  int hue() const override { return 0; }
};

}  // namespace
}  // namespace shapes

PLUGINLIB_EXPORT_CLASS(shapes::Square, shapes::Shape)
PLUGINLIB_EXPORT_CLASS(shapes::Triangle, shapes::Shape)
PLUGINLIB_EXPORT_CLASS(shapes::Red, shapes::Colour)
