"""Ctrl-C while the command is imported ends it with code 130 and without a word."""

import os
import subprocess
import sys

import pytest
from saltus._starting import is_command


@pytest.mark.parametrize(
    ("name", "whole", "yes"),
    [
        ("/usr/bin/saltus", [], True),
        ("saltus.exe", [], True),
        ("-m", ["python", "-m", "saltus", "list"], True),
        ("-m", ["python", "-m", "pytest"], False),
        ("-c", ["python", "-c", "import saltus"], False),
        ("my_saltus.py", [], False),
        ("", [], False),
    ],
)
def test_which_process_is_the_command(name, whole, yes):
    assert is_command(name, whole) is yes


# Ctrl-C comes as soon as the module in the placeholder is about to be imported.
PROGRAM = """
import os, signal, sys

class Interrupts:
    def find_spec(self, name, path=None, target=None):
        if name == {module!r}:
            os.kill(os.getpid(), signal.SIGINT)
        return None

sys.meta_path.insert(0, Interrupts())
sys.argv = {argv!r}
{rest}
"""


def run(module, argv, rest):
    program = PROGRAM.format(module=module, argv=argv, rest=rest)
    return subprocess.run(
        [sys.executable, "-c", program],
        capture_output=True,
        text=True,
        timeout=60,
        env=os.environ,
    )


START = "from saltus.cli import main\nsys.exit(main())"


@pytest.mark.parametrize("module", ["saltus._core", "saltus.results", "saltus.cli.table"])
def test_the_command_ends_quietly(module):
    done = run(module, ["/usr/bin/saltus", "list"], START)
    assert (done.returncode, done.stdout, done.stderr) == (130, "", "")


def test_a_program_that_imports_saltus_gets_its_exception():
    done = run("saltus.results", ["mine.py"], "import saltus")
    assert "KeyboardInterrupt" in done.stderr


def test_after_the_import_the_usual_answer_is_back():
    rest = "import saltus.cli\nprint(signal.getsignal(signal.SIGINT) is signal.default_int_handler)"
    done = run("no such module", ["/usr/bin/saltus"], rest)
    assert done.stdout == "True\n"


def test_an_answer_of_the_users_own_stays():
    rest = "signal.signal(signal.SIGINT, signal.SIG_IGN)\nimport saltus\nprint('went on')"
    done = run("saltus.results", ["/usr/bin/saltus"], rest)
    assert (done.returncode, done.stdout) == (0, "went on\n")
