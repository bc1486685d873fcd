// SPDX-License-Identifier: Apache-2.0
// A library of plugins.
#include <memory>
#include <pluginlib/class_list_macros.hpp>
#include <utility>

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

class Sketch : public Drawing {
 public:
  Sketch(const std::string& title, std::unique_ptr<int> size) : title_(title), size_(std::move(size)) {}
  std::string text() const override { return title_ + " " + std::to_string(*size_); }

 private:
  std::string title_;
  std::unique_ptr<int> size_;
};

}  // namespace
}  // namespace shapes

PLUGINLIB_EXPORT_CLASS(shapes::Square, shapes::Shape)
PLUGINLIB_EXPORT_CLASS(shapes::Triangle, shapes::Shape)
PLUGINLIB_EXPORT_CLASS(shapes::Red, shapes::Colour)
PLUGINLIB_EXPORT_CLASS(shapes::Sketch, shapes::Drawing)
