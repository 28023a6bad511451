"""Types and classes. Source: Zlatanov, Fenton, Benhabib (1998), Table 1 and section 2.3."""

from itertools import product

import pytest

from singsym.classes.taxonomy.types import (
    Defects,
    SingularityType,
    class_of,
    feasible_classes,
    feasible_defects,
    table,
)

# Table 1 read row by row; the order of the numbering is the project's (theory.md, section 1).
TABLE_1 = """RI IO|RO II|RI RO II IO|RPM II IO|RI RPM II IO|RO RPM II IO|RI RO RPM II IO|RI RO IIM|
RI RO IO IIM|RI RO II IIM|RI RO II IO IIM|RPM IIM|RI RPM IO IIM|RO RPM II IIM|RPM II IO IIM|RI RPM II IO IIM|
RO RPM II IO IIM|RI RO RPM IIM|RI RO RPM IO IIM|RI RO RPM II IIM|RI RO RPM II IO IIM""".replace("\n", "")


def test_the_twenty_one_classes_in_order() -> None:
    assert [" ".join(c.types.names) for c in feasible_classes(3)] == TABLE_1.split("|")
    assert [c.number for c in feasible_classes(3)] == list(range(1, 22))


@pytest.mark.parametrize(("n", "count"), [(1, 9), (2, 19), (3, 21), (6, 21)])
def test_counts(n: int, count: int) -> None:
    assert len(feasible_classes(n)) == count


def test_two_degrees_of_freedom_miss_classes_7_and_11() -> None:
    assert {c.number for c in feasible_classes(3)} - {c.number for c in feasible_classes(2)} == {7, 11}


def test_layout_of_table_1() -> None:
    found = table(3)
    assert [" ".join(t.names) for t in found.columns] == [
        "IO", "II", "IIM", "II IO", "IO IIM", "II IIM", "II IO IIM",
    ]  # fmt: skip
    assert [[c.number if c else 0 for c in row] for row in found.cells] == [
        [1, 0, 0, 0, 0, 0, 0],
        [0, 2, 0, 0, 0, 0, 0],
        [0, 0, 12, 4, 0, 0, 15],
        [0, 0, 8, 3, 9, 10, 11],
        [0, 0, 0, 5, 13, 0, 16],
        [0, 0, 0, 6, 0, 14, 17],
        [0, 0, 18, 7, 19, 20, 21],
    ]


@pytest.mark.parametrize("n", [1, 2, 3])
def test_larger_defects_give_no_further_class(n: int) -> None:
    """The lemma of `feasible_defects`, by brute force over a larger box."""
    box = (Defects(*d) for d in product(range(5), range(5), range(n + 5), range(n + 5)))
    assert {d.types for d in box if d.is_feasible(n)} <= {d.types for d in feasible_defects(n)}


def test_from_three_on_the_classes_are_the_same() -> None:
    """The lemma of `feasible_classes`, by brute force; for a large n nothing is enumerated."""
    classes = {c.types for c in feasible_classes(3)} | {SingularityType(0)}
    assert all({d.types for d in feasible_defects(n)} == classes for n in (4, 5, 6))
    assert feasible_classes(99999) == feasible_classes(3)


def test_every_feasible_tuple_is_realised_by_a_matrix() -> None:
    """With no passive rank, T and input columns on unit vectors e_i that overlap as little as they must."""
    for n in (1, 2, 3):
        for d in feasible_defects(n):
            N = n + d.p
            outputs = [i if i < N - d.k_I else None for i in range(n)]
            inputs = [N - d.delta - 1 - j if j < N - d.k_O else None for j in range(n)]
            r_I, r_O = set(outputs) - {None}, set(inputs) - {None}
            found = Defects.of_ranks(len(r_I | r_O), len(r_I), len(r_O), 0, N, n)
            assert found == d


def test_membership() -> None:
    for n in (1, 2, 3):
        for c in feasible_classes(n):
            assert c.defects(n)
            assert all(class_of(d.types) == c for d in c.defects(n))
    with pytest.raises(ValueError, match="no configuration has exactly"):
        class_of(SingularityType.RI)
    assert class_of(SingularityType(0)) is None
    with pytest.raises(ValueError, match="n >= 1"):
        feasible_classes(0)
