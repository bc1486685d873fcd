// SPDX-License-Identifier: Apache-2.0
#include "launcher/python/interpreter/python_module.hpp"

#include <dlfcn.h>
#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "base/environment/own_prefix.hpp"
#include "launcher/python/interpreter/python_guest.hpp"

namespace launch {

namespace {

std::string& module_path() {
  static std::string path;
  return path;
}

// Never freed, as the interpreter of the module is not: launch files hold objects of it until the end.
python::Runtime*& given_runtime() {
  static python::Runtime* runtime = nullptr;
  return runtime;
}

bool& shows_tracebacks() {
  static bool shows = false;
  return shows;
}

python::Runtime* load_module() {
  if (given_runtime() != nullptr) {
    return given_runtime();
  }
  std::string path = module_path();
  std::error_code ignored;
  if (path.empty()) {
    path = own_library_file("liblaunch_python.so");
  }
  if (!std::filesystem::exists(path, ignored)) {
    throw std::runtime_error(fmt::format(
        "this build has no Python: '{}' does not exist; install python3-dev and pybind11-dev and build again", path));
  }
  // Global, because the extension modules of Python take their symbols from this library.
  void* const module = ::dlopen(path.c_str(), RTLD_NOW | RTLD_GLOBAL);
  void* const symbol = module == nullptr ? nullptr : ::dlsym(module, python::kGetRuntimeSymbol);
  if (symbol == nullptr) {
    throw std::runtime_error(
        fmt::format("can't load Python: {}; install libpython" LAUNCH_PYTHON_VERSION, ::dlerror()));
  }
  return reinterpret_cast<python::GetRuntime>(symbol)();
}

// Throws std::runtime_error.
python::Runtime& loaded_runtime() {
  static python::Runtime* const runtime = load_module();
  return *runtime;
}

}  // namespace

void use_python_module(std::string path) {
  module_path() = std::move(path);
}

void use_python_runtime(std::unique_ptr<python::Runtime> runtime) {
  given_runtime() = runtime.release();
}

void show_python_tracebacks() {
  shows_tracebacks() = true;
}

python::Runtime& python_runtime() {
  python::Runtime& runtime = loaded_runtime();
  const auto report_deaths = [](int descriptor) { loaded_runtime().report_deaths(descriptor); };
  become_guest(report_deaths);
  python_has_started(report_deaths);
  if (shows_tracebacks()) {
    runtime.show_tracebacks();
  }
  return runtime;
}

std::optional<python::SyntaxError> python_syntax_error(const std::string& text) {
  try {
    return loaded_runtime().syntax_error(text);
  } catch (const std::runtime_error&) {
    return std::nullopt;
  }
}

std::string evaluate_python(const std::string& expression, const std::string& modules, PythonPlace place) {
  std::optional<GuestRefusal> refusal;
  try {
    python::Runtime& runtime = python_runtime();
    refusal = guest_refusal(expression);
    if (!refusal) {
      const GuestCall call(expression, std::move(place));
      return runtime.evaluate(expression, modules);
    }
  } catch (const std::runtime_error& error) {
    const bool lacks_memory = std::string_view(error.what()).starts_with("MemoryError");
    throw EvaluationError(error.what(), lacks_memory ? "--python-memory gives it more" : "");
  }
  throw EvaluationError(refusal->reason, refusal->help);
}

}  // namespace launch
