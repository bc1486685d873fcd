# SPDX-License-Identifier: Apache-2.0
# ament_lint_auto: the linters that package.xml names as test dependencies. This stack contains none of them.
include(CMakeFindDependencyMacro)
find_dependency(ament_cmake)

# ament_lint_auto_find_test_dependencies(): says that no linter runs.
function(ament_lint_auto_find_test_dependencies)
  message(STATUS "${PROJECT_NAME}: no linters here, its lint tests are left out")
endfunction()
