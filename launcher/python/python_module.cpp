// liblaunch_python.so: CPython for $(eval …). Loaded with dlopen on first use, so that launching without Python
// expressions costs and needs no Python.
#include <pybind11/embed.h>

#include <sstream>
#include <string>

namespace py = pybind11;

namespace {

// The interpreter lives until the program ends: finalising it would only cost time.
void start_interpreter() {
  PyConfig config;
  PyConfig_InitPythonConfig(&config);
  config.install_signal_handlers = 0;
  config.parse_argv = 0;
  // Else the first python3 on the PATH would tell where the standard library is, whatever version it has.
  PyConfig_SetBytesString(&config, &config.program_name, LAUNCH_PYTHON_PROGRAM);
  const PyStatus status = Py_InitializeFromConfig(&config);
  PyConfig_Clear(&config);
  if (PyStatus_Exception(status)) {
    throw std::runtime_error(status.err_msg != nullptr ? status.err_msg : "Python can't be initialised");
  }
}

std::string evaluate(const char* expression, const char* modules) {
  if (Py_IsInitialized() == 0) {
    start_interpreter();
  }
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
  // Python's own eval() passes over blanks at the front, as pybind11's does not.
  return py::str(py::module_::import("builtins").attr("eval")(expression, names));
}

}  // namespace

extern "C" __attribute__((visibility("default"))) bool launch_evaluate_python(const char* expression,
                                                                              const char* modules,
                                                                              std::string* result) {
  try {
    *result = evaluate(expression, modules);
    return true;
  } catch (py::error_already_set& error) {
    // "NameError: name 'x' is not defined", without the traceback.
    try {
      *result = error.type().attr("__name__").cast<std::string>() + ": " + py::str(error.value()).cast<std::string>();
    } catch (const std::exception&) {
      *result = "a Python error that can't be shown";
    }
  } catch (const std::exception& error) {
    *result = error.what();
  }
  return false;
}
