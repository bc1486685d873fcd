// SPDX-License-Identifier: Apache-2.0
#include "launcher/python/module/entity_reader.hpp"

#include <pybind11/stl.h>

#include "launcher/python/module/python_failure.hpp"

namespace py = pybind11;

namespace launch::python {

namespace {

std::string read_str(const py::handle& value);

class PythonObject : public Object {
 public:
  explicit PythonObject(py::object object) : object_(std::move(object)) {}
  PythonObject(const PythonObject&) = delete;
  PythonObject& operator=(const PythonObject&) = delete;
  ~PythonObject() override {
    const py::gil_scoped_acquire lock;
    object_ = py::object();
  }

  std::string perform(Host& host) override {
    return run_python(host, [&] { return read_str(object_.attr("_perform")()); });
  }
  std::string describe() override {
    const py::gil_scoped_acquire lock;
    try {
      return object_.attr("describe")().cast<std::string>();
    } catch (const std::exception&) {
      return py::str(py::type::of(object_).attr("__name__")).cast<std::string>() + "()";
    }
  }
  std::vector<Entity> execute(Host& host) override {
    return run_python(host, [&] { return read_entities(object_.attr("_execute")()); });
  }
  std::optional<std::string> function() override {
    const py::gil_scoped_acquire lock;
    try {
      return object_.attr("_calls")().cast<std::optional<std::string>>();
    } catch (const std::exception&) {
      return py::str(py::type::of(object_).attr("__name__")).cast<std::string>();
    }
  }
  void start(Host& host) override {
    run_python(host, [&] { object_.attr("_start")(); });
  }

 private:
  py::object object_;
};

// Objects that hold each other more deeply than this would exhaust the stack, here or when they are visited.
constexpr int kDeepest = 200;

// Counts how deeply the objects that are being read hold each other.
class Level {
 public:
  Level() {
    if (++depth() > kDeepest) {
      --depth();
      throw Error("objects of the launch file hold each other more than " + std::to_string(kDeepest) + " deep", {}, {},
                  {}, nullptr);
    }
  }
  Level(const Level&) = delete;
  Level& operator=(const Level&) = delete;
  ~Level() { --depth(); }

 private:
  static int& depth() {
    static int value = 0;
    return value;
  }
};

// Reads a str for the launcher. Throws Error for a text that can't be passed to a program.
std::string read_str(const py::handle& value) {
  std::string text;
  try {
    text = value.cast<std::string>();
  } catch (const py::cast_error&) {
    throw Error("a text holds characters that are no Unicode: " + py::repr(value).cast<std::string>(), {}, {}, {},
                nullptr);
  }
  if (text.find('\0') != std::string::npos) {
    throw Error("a text holds the character NUL: " + py::repr(value).cast<std::string>(), {}, {}, {}, nullptr);
  }
  return text;
}

Part read_part(const py::handle& value) {
  Part part;
  if (py::isinstance<py::str>(value)) {
    part.text = read_str(value);
    return part;
  }
  part.where = read_place(value.attr("_place")());
  const py::object call = value.attr("_part")();
  if (call.is_none()) {
    part.kind = Part::Kind::kObject;
    part.object = std::make_shared<PythonObject>(py::reinterpret_borrow<py::object>(value));
  } else if (py::isinstance<py::str>(call)) {
    part.text = read_str(call);
  } else {
    const auto parts = call.cast<py::tuple>();
    part.kind = Part::Kind::kCall;
    part.text = parts[0].cast<std::string>();
    for (const py::handle argument : parts[1]) {
      part.arguments.push_back(read_text(argument));
    }
  }
  return part;
}

Value read_value(const py::handle& value) {
  const Level level;
  if (py::isinstance<py::bool_>(value)) {
    return {value.cast<bool>(), {}};
  }
  if (py::isinstance<py::int_>(value)) {
    try {
      return {value.cast<std::int64_t>(), {}};
    } catch (const py::cast_error&) {
      throw Error("a number has more than 64 bits: " + py::str(value).cast<std::string>(), {}, {}, {}, nullptr);
    }
  }
  if (py::isinstance<py::float_>(value)) {
    return {value.cast<double>(), {}};
  }
  if (py::isinstance<py::list>(value)) {
    std::vector<Value> items;
    for (const py::handle item : value) {
      items.push_back(read_value(item));
    }
    return {std::move(items), {}};
  }
  Text text = read_text(value);
  Place where = text.where;
  return {std::move(text), std::move(where)};
}

// Throws Error without a place for what can't be read.
void read_content(const py::tuple& tuple, Entity& entity) {
  for (const py::handle item : tuple[2]) {
    const auto attribute = item.cast<py::tuple>();
    Value value = read_value(attribute[1]);
    if (attribute.size() > 2 && !attribute[2].is_none()) {
      value.where = read_place(attribute[2]);
    }
    entity.attributes.emplace_back(attribute[0].cast<std::string>(), std::move(value));
  }
  entity.children = read_entities(tuple[3]);
  if (!tuple[4].is_none()) {
    entity.object = std::make_shared<PythonObject>(tuple[4].cast<py::object>());
  }
  entity.process_name = tuple[5].cast<std::string>();
}

Entity read_entity(const py::tuple& tuple) {
  const Level level;
  Entity entity;
  entity.tag = tuple[0].cast<std::string>();
  entity.where = read_place(tuple[1]);
  try {
    read_content(tuple, entity);
  } catch (Error& error) {
    if (error.where.line == 0) {
      error.where = entity.where;
    }
    throw;
  } catch (const py::error_already_set& error) {
    throw Error(py::str(error.value()).cast<std::string>(), entity.where, {}, {}, nullptr);
  } catch (const py::cast_error& error) {
    throw Error(error.what(), entity.where, {}, {}, nullptr);
  }
  return entity;
}

}  // namespace

ObjectPtr make_object(py::object object) {
  return std::make_shared<PythonObject>(std::move(object));
}

std::vector<Entity> read_entities(const py::handle& entities) {
  std::vector<Entity> result;
  for (const py::handle entity : entities) {
    result.push_back(read_entity(entity.cast<py::tuple>()));
  }
  return result;
}

Text read_text(const py::handle& value) {
  const Level level;
  Text text;
  if (!py::isinstance<py::tuple>(value)) {
    text.parts.push_back(read_part(value));
  } else {
    for (const py::handle part : value) {
      text.parts.push_back(read_part(part));
    }
  }
  if (!text.parts.empty()) {
    text.where = text.parts.front().where;
  }
  return text;
}

}  // namespace launch::python
