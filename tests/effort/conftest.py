"""What the tests of engines use: systems of equations, and nothing remembered from the test before."""

from tests.elimination.conftest import _clean, katsura

__all__ = ["_clean", "katsura"]
