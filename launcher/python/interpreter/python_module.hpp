// SPDX-License-Identifier: Apache-2.0
// The CPython of this launcher: liblaunch_python.so, loaded when the first Python is met.
#pragma once

#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "launcher/python/interpreter/python_runtime.hpp"
#include "launcher/python/interpreter/python_watch.hpp"

namespace launch {

// Throws std::runtime_error when the module can't be loaded; the message says what to install.
python::Runtime& python_runtime();

// Loads the module from this path instead of ../lib/launch beside the program's directory. For programs that are not
// installed. It has an effect only before the first use of Python.
void use_python_module(std::string path);

// Takes this runtime in place of the module. It has an effect only before the first use of Python.
void use_python_runtime(std::unique_ptr<python::Runtime> runtime);

// From now on errors of Python carry its traceback. Does not load the module.
void show_python_tracebacks();

// str() of the value of `expression`. `modules` are names separated by commas; the names of "math" are also available
// unqualified. `place` is that of the expression in its launch file, for messages about a launch that Python has ended.
// Throws EvaluationError: Python's error, or what to install when there is no Python. Must not be called by several
// threads at once.
std::string evaluate_python(const std::string& expression, const std::string& modules, PythonPlace place);

// What is wrong with `text` as a program of Python; nullopt for nothing, and without a Python. Nothing of the text
// runs, so this makes no guest. The first call starts the interpreter: processes that are forked then have their answer
// soon.
std::optional<python::SyntaxError> python_syntax_error(const std::string& text);

// what() is one line.
struct EvaluationError : std::runtime_error {
  EvaluationError(const std::string& message, std::string help_)
      : std::runtime_error(message), help(std::move(help_)) {}

  std::string help;  // "" if there is none
};

}  // namespace launch
