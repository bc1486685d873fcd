#include "launcher/substitution/python_expression.hpp"

#include <dlfcn.h>
#include <fmt/format.h>

#include <filesystem>
#include <stdexcept>
#include <utility>

namespace launch {

namespace {

std::string& module_path() {
  static std::string path;
  return path;
}

PythonEvaluate load_module() {
  std::string path = module_path();
  std::error_code ignored;
  if (path.empty()) {
    const auto program = std::filesystem::read_symlink("/proc/self/exe", ignored);
    path = (program.parent_path().parent_path() / "lib/launch/liblaunch_python.so").string();
  }
  if (!std::filesystem::exists(path, ignored)) {
    throw std::runtime_error(fmt::format(
        "this build has no Python: '{}' does not exist; install python3-dev and pybind11-dev and build again", path));
  }
  // Global, because the extension modules of Python take their symbols from it.
  void* const module = ::dlopen(path.c_str(), RTLD_NOW | RTLD_GLOBAL);
  void* const symbol = module == nullptr ? nullptr : ::dlsym(module, kPythonEvaluateSymbol);
  if (symbol == nullptr) {
    throw std::runtime_error(fmt::format("can't load Python: {}; install libpython3.11", ::dlerror()));
  }
  return reinterpret_cast<PythonEvaluate>(symbol);
}

}  // namespace

void use_python_module(std::string path) {
  module_path() = std::move(path);
}

std::string evaluate_python(const std::string& expression, const std::string& modules) {
  static const PythonEvaluate evaluate = load_module();
  std::string result;
  if (!evaluate(expression.c_str(), modules.c_str(), &result)) {
    throw std::runtime_error(result);
  }
  return result;
}

}  // namespace launch
