"""The real program, as a user starts it."""

import contextlib
import json
import os
import pathlib
import signal
import subprocess

PROGRAM = os.environ["SERVOID_PROGRAM"]
SOURCE = pathlib.Path(os.environ["SERVOID_SOURCE_DIR"])
EXAMPLES = SOURCE / "examples"
DATA = pathlib.Path(os.environ.get("SERVOID_DATA_DIR") or SOURCE / "../shared/data").resolve()


def run(*words, code=0, timeout=280):
    command = [PROGRAM, *map(str, words)]
    done = subprocess.run(command, capture_output=True, text=True, timeout=timeout)
    if done.returncode != code:
        raise AssertionError(f"{words}: exit {done.returncode}\n{done.stdout}{done.stderr}")
    return done


def answer(*words):
    return json.loads(run(*words, "--json").stdout)


def start_studio(*words):
    """The process and its address."""
    process = subprocess.Popen(
        [PROGRAM, "studio", *map(str, words)], stdout=subprocess.PIPE, text=True
    )
    line = process.stdout.readline()
    if "http://" not in line:
        process.kill()
        raise AssertionError(f"studio {words} said {line!r}")
    return process, line.split()[-1]


def end(process, by=signal.SIGINT):
    """Its exit code."""
    process.send_signal(by)
    try:
        return process.wait(10)
    finally:
        process.kill()
        process.stdout.close()


@contextlib.contextmanager
def studio(*words):
    process, url = start_studio(*words)
    try:
        yield url
    finally:
        end(process)
