// SPDX-License-Identifier: Apache-2.0
// The interface between the launcher and liblaunch_python.so: plain data to the launcher, and two small interfaces.
//
// The module runs Python. It turns the objects of a launch file into the entities below, each with the place where the
// file makes it. The launcher decides what they mean, as for XML and YAML. Functions and substitutions of the user can
// run only in Python. They stay Objects, which the launcher calls during the visit. Only one thread may use this.
#pragma once

#include <cstdint>
#include <exception>
#include <map>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace launch::python {

// A place in a Python file. `line` counts from 1, 0 when it is unknown; `begin` and `end` are bytes of the line from 0.
struct Place {
  std::string file;
  std::uint32_t line = 0;
  std::uint32_t begin = 0;
  std::uint32_t end = 0;
};

class Object;
using ObjectPtr = std::shared_ptr<Object>;

struct Text;

// A piece of a text: literal text, a substitution of the launcher's called by name, or one that Python performs.
struct Part {
  enum class Kind { kText, kCall, kObject };

  Kind kind = Kind::kText;
  std::string text;             // literal text, or the name of the substitution
  std::vector<Text> arguments;  // of the substitution
  ObjectPtr object;
  Place where;
};

// Parts that are pasted together.
struct Text {
  std::vector<Part> parts;
  Place where;
};

struct Value {
  std::variant<bool, std::int64_t, double, Text, std::vector<Value>> data;
  Place where;
};

// An action or an item of one, as in launcher/frontend/entity.hpp. With an object it is an action that Python executes;
// only the attributes `if` and `unless` are given then.
struct Entity {
  std::string tag;
  Place where;
  std::vector<std::pair<std::string, Value>> attributes;
  std::vector<Entity> children;
  ObjectPtr object;
  // A name by which event handlers refer to the processes that the action starts; empty when no handler refers to them.
  std::string process_name;
};

// An element of an XML or YAML file, for the class of a package that makes an action of it.
struct Element {
  struct Attribute {
    std::string name;
    Place name_where;
    Value value;
    bool untyped = false;  // a text of XML, which has no type of its own
  };

  std::string tag;
  Place where;
  std::vector<Attribute> attributes;
  std::vector<Element> children;
  std::size_t number = 0;  // stands for the element in what Python gives back
  bool is_item = false;    // an item of a YAML list under a key
};

// An argument of a substitution that a package makes: its pieces are texts, or numbers that stand for substitutions.
using Argument = std::vector<std::variant<std::string, std::size_t>>;

// What packages offer to XML and YAML files.
struct ExposedNames {
  std::vector<std::string> names;
  std::string problem;  // why packages could not be loaded; empty when all could
};

// The launch, for Python while it runs. Calls throw what the launcher throws.
class Host {
 public:
  using Variables = std::map<std::string, std::string>;

  virtual ~Host() = default;
  virtual Variables& configurations() = 0;
  virtual Variables& environment() = 0;
  virtual std::string log_directory() = 0;
  virtual std::string perform(const Text& text) = 0;
  // The value of a text with configurations of its own, not those of the launch.
  virtual std::string perform(const Text& text, Variables& configurations) = 0;
  // "debug", "info", "warning", "error", "critical".
  virtual void message(const std::string& level, const std::string& logger, const std::string& text) = 0;
  // push() saves all that a scope restores, or only the environment. pop() restores it. Both work as a stack, and throw
  // outside a visit. pop() throws if nothing is saved.
  virtual void push(bool environment) = 0;
  virtual void pop(bool environment) = 0;
  // Visits the actions now.
  virtual void visit(const std::vector<Entity>& entities) = 0;
  // Has a coroutine started once the traversal is carried out.
  virtual void run_coroutine(ObjectPtr object) = 0;
};

// A Python object that the launch asks for something. Throws Error.
class Object {
 public:
  virtual ~Object() = default;
  // The text of a substitution, or "true" or "false" for a condition.
  virtual std::string perform(Host& host) = 0;
  virtual std::string describe() = 0;
  // The entities to visit in place of an action.
  virtual std::vector<Entity> execute(Host& host) = 0;
  // The function of the launch file that perform() of a condition or execute() would call; nullopt for none.
  virtual std::optional<std::string> function() = 0;
  // Starts the object, which is a coroutine.
  virtual void start(Host& host) = 0;
};

// The state of the coroutines after a step.
struct Pause {
  std::size_t running = 0;        // how many have not ended
  std::size_t background = 0;     // how many others have not ended, which do not keep the launch going
  int descriptor = -1;            // when it is readable, a step has something to do
  std::optional<double> seconds;  // until a step has something to do by itself
};

// What Python's compiler says about a text that is no program. Lines and columns count from 0, columns in characters.
struct SyntaxError {
  std::string message;
  std::uint32_t line = 0;
  std::uint32_t column = 0;
  std::uint32_t last_line = 0;
  std::uint32_t last_column = 0;
};

// A Python launch file or a Python object failed. what() is one line.
class __attribute__((visibility("default"))) Error : public std::runtime_error {
 public:
  Error(const std::string& message, Place where_, std::string help_, std::string traceback_, std::exception_ptr cause_)
      : std::runtime_error(message),
        where(std::move(where_)),
        help(std::move(help_)),
        traceback(std::move(traceback_)),
        cause(std::move(cause_)) {}

  Place where;
  std::string help;
  std::string traceback;     // as Python prints it; empty unless show_tracebacks() was called
  std::exception_ptr cause;  // the exception of a call of the host, when Python passed it on
};

class Runtime {
 public:
  virtual ~Runtime() = default;
  // From now on errors carry Python's traceback. To make one takes longer than all else of an error.
  virtual void show_tracebacks() = 0;
  // From now on what ends this process while Python runs (a signal that kills, os._exit()) first writes into the
  // descriptor where Python is.
  virtual void report_deaths(int descriptor) = 0;
  // What is wrong with a text as a program; nullopt for nothing. Nothing of it runs. The first call starts the
  // interpreter, but not what the user's installation does at its start (Python's module `site`): that is left to the
  // first call of another function. So a process can be forked from here that has its answer soon.
  virtual std::optional<SyntaxError> syntax_error(const std::string& text) = 0;
  // str() of the value of an expression (evaluate_python() in python_module.hpp). Throws std::runtime_error.
  virtual std::string evaluate(const std::string& expression, const std::string& modules) = 0;
  // Runs a launch file. `text` is its content. Throws Error.
  virtual std::vector<Entity> load(const std::string& path, const std::string& text, Host& host) = 0;
  // What a package makes of an element, or of the call of a substitution; nullopt when none knows the name. The first
  // call imports the packages of the entry points `launch.frontend.launch_extension`. Throws Error.
  virtual std::optional<std::vector<Entity>> make_action(const Element& element, Host& host) = 0;
  virtual std::optional<Text> make_substitution(const std::string& name, const std::vector<Argument>& arguments,
                                                const Place& where, Host& host) = 0;
  virtual ExposedNames exposed_names(bool of_actions, Host& host) = 0;
  // Runs the coroutines until all of them wait. Throws the Error that one of them has raised.
  virtual Pause step_coroutines(Host& host) = 0;
  // Asks all coroutines to end, which takes further steps.
  virtual void cancel_coroutines(Host& host) = 0;
};

// What the module exports. It never returns null, and the runtime lives as long as the program. This function starts
// nothing; the first call of the runtime does.
using GetRuntime = Runtime* (*)();
constexpr const char* kGetRuntimeSymbol = "launch_python_runtime";

}  // namespace launch::python
