// SPDX-License-Identifier: Apache-2.0
// `launch convert`: a launch file in another language, with the proof that it plans the same.
#include <fmt/format.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <regex>

#include "actions/builtin_actions.hpp"
#include "base/diagnostics/read_source_file.hpp"
#include "base/environment/own_environment.hpp"
#include "base/environment/own_prefix.hpp"
#include "launcher/frontend/frontend.hpp"
#include "launcher/language/launch_description.hpp"
#include "launcher/plan/dry_run.hpp"
#include "launcher/process/output/output_router.hpp"
#include "launcher/python/interpreter/python_guest.hpp"
#include "launcher/visit/launch_plan.hpp"
#include "programs/command_line/result_output.hpp"
#include "programs/command_line/subcommand.hpp"
#include "programs/launch/command_functions.hpp"
#include "programs/launch/rewrite/convert.hpp"
#include "programs/launch/rewrite/rewritten_files.hpp"

namespace launch {

namespace {

using PlanJson = nlohmann::json;
using Arguments = std::vector<std::pair<std::string, std::string>>;

// Without the places in the file, and without the time.
PlanJson without_places(PlanJson value) {
  if (value.is_object()) {
    value.erase("source");
  }
  if (value.is_string()) {
    static const std::regex place_or_time(R"( \([^()]*\.launch\.[a-z]+:[0-9]+:[0-9]+\)$|[0-9]{14})");
    return std::regex_replace(value.get<std::string>(), place_or_time, "");
  }
  if (value.is_structured()) {
    for (auto& item : value) {
      item = without_places(item);
    }
  }
  return value;
}

// What a file would do, with the parts that conditions leave out, and what is wrong with it.
struct Plan {
  PlanJson json;
  std::vector<std::string> errors;
};

Plan plan_of(const std::shared_ptr<const SourceFile>& file, const Registry& registry, const Arguments& arguments) {
  LaunchContext context(registry, own_environment(), own_prefix(), [](auto, auto, auto) {});
  context.scope().log_directory = LogDirectory::choose(own_environment());
  for (const auto& [name, value] : arguments) {
    context.scope().configurations.insert_or_assign(name, value);
  }
  Plan plan;
  const auto note = [&](const LaunchError& error) {
    for (const Diagnostic& diagnostic : error.diagnostics()) {
      plan.errors.push_back(diagnostic.message);
    }
  };
  context.exploration().begin(
      {.report = [&](const LaunchError& error, bool) { note(error); }, .left_out = [](Requests) {}, .judges = false});
  try {
    const auto description = parse_launch_description(file, registry, context.scope());
    plan.json = without_places(PlanJson::parse(plan_as_json(plan_launch(context, *description), own_environment())));
  } catch (const LaunchError& error) {
    note(error);
  }
  return plan;
}

// The parts of two plans that differ, for a person; empty if there are none.
std::string difference(const Plan& before, const Plan& after) {
  if (before.errors != after.errors) {
    const auto [left, right] =
        std::mismatch(before.errors.begin(), before.errors.end(), after.errors.begin(), after.errors.end());
    return fmt::format("the given file has the error '{}', the new one '{}'", left == before.errors.end() ? "" : *left,
                       right == after.errors.end() ? "" : *right);
  }
  const PlanJson changes = PlanJson::diff(before.json, after.json);
  return changes.empty() ? "" : fmt::format("{} differs", changes.front()["path"].get<std::string>());
}

std::string ending_of(const std::string& language) {
  return language == "python" ? ".launch.py" : ".launch." + language;
}

// "robot.launch.xml" and "robot_launch.xml" become "robot.launch.yaml".
std::filesystem::path path_beside(const std::filesystem::path& given, const std::string& language) {
  const std::string name =
      std::regex_replace(given.filename().string(), std::regex("([._]launch)?\\.(xml|yaml|yml|launch)$"), "");
  return given.parent_path() / (name + ending_of(language));
}

Converted converted(const std::shared_ptr<const SourceFile>& file, const std::string& language,
                    const Registry& registry) {
  const Entity root = load_entity_tree(file);
  Comments comments(file);
  return language == "xml"    ? convert_to_xml(root, std::move(comments), registry)
         : language == "yaml" ? convert_to_yaml(root, std::move(comments), registry)
                              : convert_to_python(root, std::move(comments), registry);
}

}  // namespace

int convert_command(const Words& words) {
  std::string language;
  std::string output;
  bool print = false;
  LaunchTarget target;
  Subcommand command(
      "launch convert",
      "Writes an XML or YAML launch file in another language: XML, YAML or Python. Comments stay. What has no form in "
      "the "
      "other language is an error at its place, and then nothing is written. The plan of the new file is compared with "
      "that of the given one, with the arguments that are given; where they differ, nothing is written either. The new "
      "file stands beside the given one, which stays.");
  command.take_target(target);
  command.take_choice("--to", language, {"xml", "yaml", "python"}, "the language of the new file");
  command.take_text("-o,--output", output, "the new file");
  command.take_flag("--print", print, "print the new text instead of writing it into a file");
  PythonLimits python;
  command.take_python_limits(python);
  if (const auto exit_code = command.parse(words)) {
    return *exit_code;
  }
  if (language.empty() || target.words.size() != 1) {
    fmt::print(stderr, "{}", usage_error("launch convert", language.empty() ? "--to is missing" : "give one file"));
    return kWrongCommandLine;
  }
  run_python_in_a_guest({std::chrono::seconds(python.seconds), python.memory});
  ResultOutput result("launch convert");
  try {
    const Registry registry = builtin_actions();
    const std::string& given = target.words.front();
    if (given.ends_with(".py")) {
      throw LaunchError(fmt::format("'{}' is a program: launch convert reads XML and YAML", given), {},
                        "launch --print shows its actions");
    }
    const auto file = read_source_file(given);
    const std::filesystem::path path = output.empty() ? path_beside(given, language) : std::filesystem::path(output);
    const bool exists = !print && std::filesystem::exists(path);
    if (exists) {
      throw LaunchError(fmt::format("'{}' exists", path.string()), {},
                        "--output names another file, --print writes none");
    }
    Converted made = converted(file, language, registry);
    if (!made.errors.empty()) {
      throw LaunchError(std::move(made.errors));
    }
    const auto fresh = std::make_shared<SourceFile>(std::filesystem::absolute(path).string(), made.text);
    const auto before = std::make_shared<SourceFile>(std::filesystem::absolute(given).string(), file->text());
    const std::string differs =
        difference(plan_of(before, registry, target.arguments), plan_of(fresh, registry, target.arguments));
    if (!differs.empty()) {
      throw LaunchError("the new file would not do the same: " + differs, {file, 0, 0},
                        "nothing is written; convert this part by hand");
    }
    if (print) {
      result.print(made.text);
    } else {
      std::ofstream(path, std::ios::binary).close();  // replace_file() keeps the permissions of a file that is there
      rewrite_file(path.string(), made.text);
      result.print(path.string() + "\n");
    }
  } catch (const LaunchError& error) {
    print_errors(error, "launch convert");
    return 1;
  }
  return result.finish() ? 0 : 1;
}

}  // namespace launch
