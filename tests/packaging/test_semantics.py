"""Each numbered sentence of docs/semantics.md has a C++ test in tests/semantics, by number.

A sentence about Python alone has a Python test with the number in its name.
"""

import re
from collections import Counter
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
DOCUMENT = ROOT / "docs" / "semantics.md"
SENTENCE = re.compile(r"^\*\*(\d+\.\d+[a-z]?)\*\*", re.M)  # **2.3** at the begin of a line
CASE = re.compile(r'TEST_CASE\(\s*"(\d+\.\d+[a-z]?) ')
# How many sentences each section of the contract has; 2.9a, 5.6a and 5.6b are of their own.
SECTIONS = {1: 2, 2: 12, 3: 21, 4: 7, 5: 10, 6: 8}
PYTHON = {"6.5"}
PYTHON_TESTS = ROOT / "tests" / "python"
# def test_6_5_..., or a docstring or comment that begins with 6.5: or cites semantics 6.5
IN_PYTHON = re.compile(r'def test_[1-6]_\d|"""[1-6]\.\d+[a-z]?[:,]|semantics,? [1-6]\.\d')

SENTENCES = SENTENCE.findall(DOCUMENT.read_text())


def numbered_cases(folder):
    """Number -> how many test cases in a folder carry it."""
    files = folder.rglob("*_test.cpp")
    return Counter(number for file in files for number in CASE.findall(file.read_text()))


CASES = numbered_cases(ROOT / "tests" / "semantics")


def test_the_document_has_every_sentence_once():
    assert [number for number, times in Counter(SENTENCES).items() if times > 1] == []
    found = Counter(int(number.split(".")[0]) for number in SENTENCES)
    assert dict(found) == SECTIONS


def test_sentences_stand_in_order():
    def place(number):
        section, item, letter = re.fullmatch(r"(\d+)\.(\d+)([a-z]?)", number).groups()
        return int(section), int(item), letter

    assert SENTENCES == sorted(SENTENCES, key=place)


@pytest.mark.parametrize("number", [n for n in SENTENCES if n not in PYTHON])
def test_a_sentence_has_a_test(number):
    assert CASES[number] > 0, f"no C++ test case in tests/semantics is named '{number} ...'"


@pytest.mark.parametrize("number", sorted(PYTHON))
def test_a_sentence_about_python_has_a_test(number):
    name = f"def test_{number.replace('.', '_')}_"
    files = (PYTHON_TESTS / "semantics").glob("test_*.py")
    assert number in SENTENCES and any(name in file.read_text() for file in files)


def test_no_test_carries_a_number_that_is_no_sentence():
    assert sorted(set(CASES) - set(SENTENCES)) == []


def test_numbered_tests_are_in_one_folder():
    assert numbered_cases(ROOT / "tests") == CASES


def test_numbers_in_python_are_in_one_folder():
    files = (file for file in PYTHON_TESTS.rglob("*.py") if file.parent.name != "semantics")
    assert [str(file) for file in files if IN_PYTHON.search(file.read_text())] == []


def test_no_other_folder_cites_a_number():
    cites = re.compile(r"[Ss]emantics(\.md)?,? [1-6]\.\d")
    files = (file for file in (ROOT / "tests").rglob("*.?pp") if file.parent.name != "semantics")
    assert [str(file) for file in files if cites.search(file.read_text())] == []
