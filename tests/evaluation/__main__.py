# SPDX-License-Identifier: Apache-2.0
"""The command line of `./dev evaluate`; docs/evaluation.md describes it."""

import argparse
import dataclasses
import datetime
import os
import signal
import sys
import time
import traceback
from pathlib import Path

from . import compare, isolation, machine, markdown, page, results, ros2, steps
from .measures.benchmark import BenchmarkError
from .presets import PRESETS
from .session import PLANS, SessionError
from .tuning import Tuning
from .worker import WorkerError


def parse(arguments):
    parser = argparse.ArgumentParser(prog='./dev evaluate', allow_abbrev=False, description=(
        'Measures what tracing, the stack, the launcher and the tools cost, and writes a page and a JSON file.'))
    parser.add_argument('--preset', choices=PRESETS, default='quick', help='; '.join(
        f'{preset.name}: {preset.about}' for preset in PRESETS.values()))
    parser.add_argument('--only', action='append', metavar='NAME', choices=steps.NAMES,
                        help=f"measures this alone (may be repeated): {', '.join(steps.NAMES)}")
    parser.add_argument('--session', choices=PLANS, default='paper', help=(
        'what the experiment records with: the settings of the paper, or the default of <trace> with three contexts'))
    parser.add_argument('--with-ros2', type=Path, metavar='PREFIX', help=(
        'builds the measured programs against this installation of ROS 2 as well, and measures both in turns (steps stack, calls, '
        'local, discovery, entities)'))
    parser.add_argument('--output', type=Path, metavar='DIR', help='where the results go (default: build/evaluation/TIME)')
    parser.add_argument('--programs', type=Path, default=Path('build/release'), metavar='DIR', help=argparse.SUPPRESS)
    parser.add_argument('--from', dest='given', type=Path, metavar='FILE', help=(
        'measures nothing, and takes the result of an earlier run instead'))
    parser.add_argument('--compare', type=Path, metavar='FILE', help=(
        'says which figures have changed beyond noise since the result in FILE; exit code 3 if some are worse'))
    parser.add_argument('--markdown', nargs='?', const='-', metavar='PAGE', help=(
        'prints the tables as Markdown, or puts them between the marks of a page'))
    # For ./dev: prints what the steps need to be built, or nothing.
    parser.add_argument('--targets', action='store_true', help=argparse.SUPPRESS)
    parser.add_argument('--no-real-time', action='store_true', help='leaves the scheduling of the programs as it is')
    return parser.parse_args(arguments)


def say(text):
    print(text, file=sys.stderr, flush=True)


def evaluate(options, started):
    """Measures; returns the result."""
    preset = PRESETS[options.preset]
    result = {
        'written': datetime.datetime.now(datetime.timezone.utc).isoformat(timespec='seconds'),
        'preset': preset.name, 'only': options.only or [], 'machine': machine.description(), 'settings': [],
        'warnings': machine.warnings_of(machine.idle_check(), 'before the start'), 'figures': [], 'left_out': [], 'failures': [],
    }
    for warning in result['warnings']:
        say(f'evaluate: warning: {warning}')
    build = machine.build_of(options.programs)
    if build:
        result['machine']['build'] = build
    begin = machine.Jiffies()
    with isolation.Place() as place, Tuning(not options.no_real_time) as tuning:
        result['settings'] = [vars(setting) for setting in tuning.settings]
        bench = steps.Bench(options.programs.resolve(), preset, PLANS[options.session], tuning, place, say)
        if options.with_ros2:
            say(f'evaluate: building against {options.with_ros2}')
            bench = dataclasses.replace(bench, ros2=ros2.build(options.with_ros2, Path('build/evaluation/ros2').absolute()))
        for name in options.only or steps.NAMES:
            say(f'evaluate: {name}, after {time.monotonic() - started:.0f} s')
            try:
                steps.STEPS[name].run(bench, result)
            except (SessionError, WorkerError, BenchmarkError, steps.StepError) as error:
                result['failures'].append({'step': name, 'reason': str(error)})
                say(f'evaluate: error: {name}: {error}')
            except Exception as error:  # a mistake in a step must not cost what the others have measured
                result['failures'].append({'step': name, 'reason': repr(error)})
                traceback.print_exc()
    result['figures'] = [figure.as_json() for figure in result['figures']]
    use = machine.use_between(begin, machine.Jiffies(), os.cpu_count())
    result['machine'].update(stolen=use['stolen'], load_after=[round(value, 2) for value in os.getloadavg()])
    if use['stolen'] > machine.STOLEN:
        result['warnings'].append(f"The host took {100 * use['stolen']:.1f} % of the processors away during the measurements.")
    result['took_s'] = round(time.monotonic() - started, 1)
    return result


def measure(options, started):
    """Measures, writes the result and its page, and returns the result."""
    output = options.output or Path('build/evaluation') / time.strftime('%Y%m%d-%H%M%S')
    output.mkdir(parents=True, exist_ok=True)
    result = evaluate(options, started)
    results.write(result, output / 'evaluation.json')
    print(output / 'evaluation.json')
    return results.read(output / 'evaluation.json'), output


def write_markdown(result, earlier, where):
    if where == '-':
        print(markdown.tables_of(result, earlier), end='')
        return
    page_file = Path(where)
    text = markdown.put_into(page_file.read_text(), result, earlier)
    if text is None:
        raise results.ResultError(f'{where}: the page has no line "{markdown.BEGIN}" with "{markdown.END}" below it')
    page_file.write_text(text)


def main(arguments):
    started = time.monotonic()
    options = parse(arguments)
    if options.targets:
        print(' '.join('' if options.given else target for target in steps.targets_of(options.only)))
        return 0
    earlier = results.read(options.compare) if options.compare else None
    if options.with_ros2:
        ros2.environment_of(options.with_ros2)  # tells of a wrong prefix before anything else takes time
    if options.given:
        result, output = results.read(options.given), options.output
        if output:
            output.mkdir(parents=True, exist_ok=True)
    else:
        isolation.enter()
        # So that daemons and settings are put back.
        signal.signal(signal.SIGTERM, lambda *_: sys.exit(128 + signal.SIGTERM))
        result, output = measure(options, started)
    if output:
        (output / 'evaluation.html').write_text(page.html(result))
        print(output / 'evaluation.html')
    if options.markdown:
        write_markdown(result, earlier, options.markdown)
    if earlier is not None:
        comparison = compare.compare(earlier, result)
        print(comparison.text(), end='')
        if comparison.worse:
            return 3
    return 1 if result['failures'] else 0


if __name__ == '__main__':
    try:
        sys.exit(main(sys.argv[1:]))
    except KeyboardInterrupt:
        sys.exit(130)
    except (OSError, results.ResultError, ros2.Ros2Error) as problem:
        say(f'evaluate: error: {problem}')
        sys.exit(1)
