// SPDX-License-Identifier: Apache-2.0
// liblaunch_python.so: CPython for $(eval …) and Python launch files. It is loaded with dlopen on first use, so that a
// launch without Python needs no Python and takes no longer.
#include <dlfcn.h>
#include <pybind11/embed.h>
#include <pybind11/eval.h>
#include <pybind11/stl.h>

#include <filesystem>
#include <optional>
#include <sstream>
#include <string>
#include <variant>
#include <vector>

#include "launcher/python/interpreter/python_runtime.hpp"
#include "launcher/python/module/entity_reader.hpp"
#include "launcher/python/module/python_failure.hpp"

namespace py = pybind11;

namespace launch::python {
namespace {

// Elements of XML and YAML files, as the Python package `launch` reads them (launch/frontend/_element.py).

py::object write_value(const Value& value) {
  if (const auto* const list = std::get_if<std::vector<Value>>(&value.data)) {
    py::list items;
    for (const Value& item : *list) {
      items.append(write_value(item));
    }
    return items;
  }
  if (const auto* const text = std::get_if<Text>(&value.data)) {
    return text->parts.empty() ? py::object(py::none()) : py::object(py::str(text->parts.front().text));
  }
  if (const auto* const boolean = std::get_if<bool>(&value.data)) {
    return py::bool_(*boolean);
  }
  if (const auto* const whole = std::get_if<std::int64_t>(&value.data)) {
    return py::int_(*whole);
  }
  return py::float_(std::get<double>(value.data));
}

// (file, line, first byte, end byte)
py::tuple write_place(const Place& place) {
  return py::make_tuple(place.file, place.line, place.begin, place.end);
}

// (tag, place, attributes, children, number, whether it is an item); an attribute is (name, value, place of the value,
// place of the name, untyped).
py::tuple write_element(const Element& element) {
  py::list attributes;
  for (const Element::Attribute& attribute : element.attributes) {
    attributes.append(py::make_tuple(attribute.name, write_value(attribute.value), write_place(attribute.value.where),
                                     write_place(attribute.name_where), attribute.untyped));
  }
  py::list children;
  for (const Element& child : element.children) {
    children.append(write_element(child));
  }
  return py::make_tuple(element.tag, write_place(element.where), attributes, children, element.number, element.is_item);
}

}  // namespace
}  // namespace launch::python

namespace {

// The interpreter lives until the program ends: finalising it would only take time. Without `site`, nothing of the
// user's installation runs.
void start_interpreter(bool site) {
  PyConfig config;
  PyConfig_InitPythonConfig(&config);
  config.install_signal_handlers = 0;
  config.parse_argv = 0;
  config.buffered_stdio = 0;  // what a launch file prints appears among the launcher's own lines
  config.site_import = site ? 1 : 0;
  config.write_bytecode = 0;  // no __pycache__ beside the user's files
  // Otherwise the first python3 on the PATH would tell where the standard library is, whatever version it has.
  PyConfig_SetBytesString(&config, &config.program_name, LAUNCH_PYTHON_PROGRAM);
  const PyStatus status = Py_InitializeFromConfig(&config);
  PyConfig_Clear(&config);
  if (PyStatus_Exception(status)) {
    throw std::runtime_error(status.err_msg != nullptr ? status.err_msg : "Python can't be initialised");
  }
  // Fills Python's table of signal handlers. PythonInterrupt reads it, and no package may have imported the module.
  py::module_::import("_signal");
  PyEval_SaveThread();  // threads that Python starts run while the launcher waits
}

// The folder `python` beside this library, with the packages that launch files import.
std::string package_directory() {
  Dl_info info;
  if (::dladdr(reinterpret_cast<void*>(&start_interpreter), &info) == 0) {
    return {};
  }
  std::error_code ignored;
  return (std::filesystem::absolute(info.dli_fname, ignored).parent_path() / "python").string();
}

std::string evaluate(const std::string& expression, const std::string& modules) {
  py::dict names;
  names["__builtins__"] = py::module_::import("builtins");
  std::istringstream list(modules);
  for (std::string name; std::getline(list, name, ',');) {
    const std::size_t first = name.find_first_not_of(' ');
    if (first == std::string::npos) {
      continue;
    }
    name = name.substr(first, name.find_last_not_of(' ') - first + 1);
    const py::module_ module = py::module_::import(name.c_str());
    const std::string top = name.substr(0, name.find('.'));
    names[top.c_str()] = top == name ? module : py::module_::import(top.c_str());
    if (name == "math") {
      for (const auto& [key, value] : module.attr("__dict__").cast<py::dict>()) {
        if (!key.cast<std::string>().starts_with("_")) {
          names[key] = value;
        }
      }
    }
  }
  // Python's own eval() skips blanks at the front; pybind11's does not.
  return py::str(py::module_::import("builtins").attr("eval")(expression, names));
}

// The names of a file of the package `launch`. The file alone: the package takes long, and not all needs it.
py::dict names_of_file(const std::string& name) {
  py::dict names;
  names["__builtins__"] = py::module_::import("builtins");
  py::eval_file(package_directory() + "/launch/" + name, names);
  return names;
}

class CPython : public launch::python::Runtime {
 public:
  void show_tracebacks() override { launch::python::shows_tracebacks() = true; }

  void report_deaths(int descriptor) override {
    start();
    const py::gil_scoped_acquire lock;
    names_of_file("_deaths.py")["report"](descriptor);
  }

  std::optional<launch::python::SyntaxError> syntax_error(const std::string& text) override {
    if (Py_IsInitialized() == 0) {
      start_interpreter(false);
      lacks_site_ = true;
    }
    const py::gil_scoped_acquire lock;
    try {
      if (!find_syntax_error_) {
        find_syntax_error_ = names_of_file("_syntax.py")["syntax_error"].cast<py::function>().release();
      }
      const py::object found = find_syntax_error_(py::bytes(text));
      if (found.is_none()) {
        return std::nullopt;
      }
      const auto parts = found.cast<py::tuple>();
      const auto number = [&](std::size_t at) { return parts[at].cast<std::uint32_t>(); };
      return launch::python::SyntaxError{parts[0].cast<std::string>(), number(1), number(2), number(3), number(4)};
    } catch (py::error_already_set& error) {
      throw std::runtime_error(error.what());
    }
  }

  std::string evaluate(const std::string& expression, const std::string& modules) override {
    start();
    const py::gil_scoped_acquire lock;
    const launch::python::PythonInterrupt interrupt;
    try {
      return ::evaluate(expression, modules);
    } catch (py::error_already_set& error) {
      // "NameError: name 'x' is not defined", without the traceback.
      throw std::runtime_error(error.type().attr("__name__").cast<std::string>() + ": " +
                               py::str(error.value()).cast<std::string>());
    }
  }

  std::vector<launch::python::Entity> load(const std::string& path, const std::string& text,
                                           launch::python::Host& host) override {
    start();
    return launch::python::run_python(host, [&] {
      find_packages();
      return launch::python::read_entities(py::module_::import("launch._load").attr("load")(path, py::bytes(text)));
    });
  }

  std::optional<std::vector<launch::python::Entity>> make_action(const launch::python::Element& element,
                                                                 launch::python::Host& host) override {
    start();
    return launch::python::run_python(host, [&]() -> std::optional<std::vector<launch::python::Entity>> {
      const py::object made = extensions().attr("make_action")(launch::python::write_element(element));
      return made.is_none() ? std::nullopt : std::optional(launch::python::read_entities(made));
    });
  }

  std::optional<launch::python::Text> make_substitution(const std::string& name,
                                                        const std::vector<launch::python::Argument>& arguments,
                                                        const launch::python::Place& where,
                                                        launch::python::Host& host) override {
    start();
    return launch::python::run_python(host, [&]() -> std::optional<launch::python::Text> {
      const py::object made =
          extensions().attr("make_substitution")(name, arguments, launch::python::write_place(where));
      return made.is_none() ? std::nullopt : std::optional(launch::python::read_text(made));
    });
  }

  launch::python::ExposedNames exposed_names(bool of_actions, launch::python::Host& host) override {
    start();
    return launch::python::run_python(host, [&] {
      const auto found = extensions().attr("exposed")(of_actions).cast<py::tuple>();
      return launch::python::ExposedNames{found[0].cast<std::vector<std::string>>(), found[1].cast<std::string>()};
    });
  }

  launch::python::Pause step_coroutines(launch::python::Host& host) override {
    return launch::python::run_python(host, [] {
      const auto state = py::module_::import("launch._coroutines").attr("step")().cast<py::tuple>();
      return launch::python::Pause{state[0].cast<std::size_t>(), state[1].cast<std::size_t>(), state[2].cast<int>(),
                                   state[3].cast<std::optional<double>>()};
    });
  }

  void cancel_coroutines(launch::python::Host& host) override {
    launch::python::run_python(host, [] { py::module_::import("launch._coroutines").attr("cancel")(); });
  }

 private:
  void start() {
    if (Py_IsInitialized() == 0) {
      start_interpreter(true);
    } else if (lacks_site_) {
      lacks_site_ = false;
      const py::gil_scoped_acquire lock;
      try {
        py::module_::import("site").attr("main")();
      } catch (py::error_already_set& error) {
        error.discard_as_unraisable("the start of Python");
      }
    }
  }

  // Before everything else: an installed ROS 2 has packages of the same names.
  void find_packages() {
    if (!packages_found_) {
      py::module_::import("sys").attr("path").attr("insert")(0, package_directory());
      packages_found_ = true;
    }
  }

  py::module_ extensions() {
    find_packages();
    return py::module_::import("launch.frontend._extensions");
  }

  bool lacks_site_ = false;
  py::handle find_syntax_error_;  // never freed, as the interpreter is not
  bool packages_found_ = false;
};

}  // namespace

extern "C" __attribute__((visibility("default"))) launch::python::Runtime* launch_python_runtime() {
  static auto* const runtime = new CPython;
  return runtime;
}
