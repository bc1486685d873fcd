# SPDX-License-Identifier: Apache-2.0
"""What Python's compiler says about a text. Nothing of the text runs."""

import warnings


def syntax_error(text):
    """
    None for a program, else (message, line, column, last line, last column), which count from 0. Columns count characters.

    `text` is bytes in UTF-8.
    """
    text = text.decode(errors='replace')
    try:
        with warnings.catch_warnings():
            warnings.simplefilter('ignore')
            # All of the compiler: its parser alone does not know that a `return` stands outside of a function.
            compile(text.removeprefix('\ufeff'), '<launch file>', 'exec', 0, True)
    except SyntaxError as error:
        line, column = error.lineno or 1, error.offset or 1
        last, end = error.end_lineno or line, error.end_offset or column + 1
        if (last, end) <= (line, column):
            last, end = line, column + 1
        mark = text.startswith('\ufeff')
        return (f'{type(error).__name__}: {error.msg}', max(line - 1, 0), max(column - 1 + (mark and line == 1), 0),
                max(last - 1, 0), max(end - 1 + (mark and last == 1), 0))
    except (ValueError, RecursionError, MemoryError, OverflowError) as error:
        return f'{type(error).__name__}: {error}', 0, 0, 0, 0
    return None
