// SPDX-License-Identifier: Apache-2.0
// What check_launch_file() looks for, beside what the visit itself finds. A source file for each.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "base/diagnostics/diagnostic.hpp"
#include "launcher/language/launch_description.hpp"
#include "launcher/language/registry.hpp"
#include "launcher/visit/launch_plan.hpp"
#include "programs/launch/check/recorded_nodes.hpp"

namespace launch {

// What is wrong with a plan as a whole: programs, remaps, and names that must fit together. `left_out` are the requests
// of actions that their conditions leave out. Their processes are searched for, too, with warnings, and their names
// count as known.
void find_faults_of_plan(const LaunchPlan& plan, const std::vector<Requests>& left_out,
                         const std::function<void(Diagnostic)>& report);

// What is wrong with the command line of one process: a missing program, missing parameter files in the arguments, and
// remaps without effect. Of a process that a condition leaves out only the program is searched for, with a warning.
void find_faults_of_process(const ProcessSpec& spec, bool left_out, const std::function<void(Diagnostic)>& report);

// What a recorded run tells of a plan: remaps of names that the nodes do not have. A node of the plan is the recorded
// one of its name. Where the program gives the name, it is any node of a process of this program. A remap has an effect
// if the node has the name before or behind it, because the run that was recorded may have had the remap or not.
// Nothing is said of nodes that were not recorded. A rule for several nodes is told once, if none of them has the
// names.
void find_remaps_of_unknown_names(const LaunchPlan& plan, const std::vector<RecordedNode>& recorded,
                                  const std::function<void(Diagnostic)>& report);

// Text between the elements of an XML launch file, which has no effect: a warning for each. The file must have been
// loaded; one that is no XML has none.
std::vector<Diagnostic> find_stray_text(const std::shared_ptr<const SourceFile>& file);

// The unknown names in a file that has syntax errors, as far as it can be read: none on the line of such an error, and
// none in an element that has one in its start tag.
std::vector<Diagnostic> find_in_broken_file(const std::shared_ptr<const SourceFile>& file, const Registry& registry,
                                            const std::vector<Diagnostic>& syntax_errors);

// The file without the attributes that nodes and programs do not have; nullptr if there are other errors among
// `errors`, which are those of loading it. Only what does not depend on such an attribute may be told of it.
std::shared_ptr<const LaunchDescription> without_unknown_attributes(const std::shared_ptr<const SourceFile>& file,
                                                                    const Registry& registry,
                                                                    const std::vector<Diagnostic>& errors);

// What `ros2 launch` would not know (docs/extensions.md): an error for each action, item and attribute that is an
// extension. It looks at this file alone, not at the files that it includes. Throws LaunchError when the file is
// neither XML nor YAML; a Python file has no errors here.
std::vector<Diagnostic> beyond_ros2(const std::shared_ptr<const SourceFile>& file, const Registry& registry);

}  // namespace launch
