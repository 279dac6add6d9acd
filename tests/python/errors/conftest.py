import pytest


@pytest.fixture(autouse=True)
def quiet(capfd):
    """Whatever goes wrong is said by an exception: nothing is printed, least of all by C."""
    yield
    assert capfd.readouterr() == ("", "")
