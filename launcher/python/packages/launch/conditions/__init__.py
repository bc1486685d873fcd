# SPDX-License-Identifier: Apache-2.0
"""Conditions of actions."""

from launch import _names
from launch._values import literal, text
from launch.condition import Condition
from launch.substitutions import SubstitutionFailure


class InvalidConditionExpressionError(Exception):
    pass


class UnsupportedConditionError(Exception):
    pass


class IfCondition(Condition):
    """Holds when the text is true or 1."""

    _name = 'if'

    def __init__(self, predicate_expression):
        if isinstance(predicate_expression, bool):
            predicate_expression = str(predicate_expression)
        super().__init__()
        self._expression = text(predicate_expression, f'the expression of {type(self).__name__}')

    def evaluate(self, context):
        return evaluate_condition_expression(context, self._expression)

    def _attribute(self):
        return (self._name, self._expression, self._place())


class UnlessCondition(IfCondition):
    """Holds when the text is false or 0."""

    _name = 'unless'

    def evaluate(self, context):
        return not super().evaluate(context)


class LaunchConfigurationEquals(Condition):
    """Holds when a configuration has this value; None: when there is no such configuration."""

    def __init__(self, launch_configuration_name, expected_value):
        super().__init__()
        self._name, = literal(launch_configuration_name, 'launch_configuration_name')
        self._expected = None if expected_value is None else text(expected_value, 'expected_value')

    def evaluate(self, context):
        value = context.launch_configurations.get(self._name)
        if value is None or self._expected is None:
            return value is None and self._expected is None
        return value == context._perform(self._expected)


class LaunchConfigurationNotEquals(LaunchConfigurationEquals):

    def evaluate(self, context):
        return not super().evaluate(context)


VALID_TRUE_EXPRESSIONS = ['true', '1']
VALID_FALSE_EXPRESSIONS = ['false', '0']


def evaluate_condition_expression(context, expression):
    value = context._perform(text(expression, 'the expression')).strip().lower()
    if value in VALID_TRUE_EXPRESSIONS:
        return True
    if value in VALID_FALSE_EXPRESSIONS:
        return False
    raise InvalidConditionExpressionError(
        f"invalid condition expression, expected one of [true, 1, false, 0] but got '{value}'")


_names.one_class_modules(__name__)
_names.same_module(__name__, __name__ + '.evaluate_condition_expression_impl')
__all__ = ['IfCondition', 'InvalidConditionExpressionError', 'LaunchConfigurationEquals',
           'LaunchConfigurationNotEquals', 'SubstitutionFailure', 'UnlessCondition', 'evaluate_condition_expression']
