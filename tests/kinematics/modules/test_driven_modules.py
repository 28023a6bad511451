"""Modules from either end, against Assur groups taken off by hand.

By hand: take the links whose places are known, and look for the smallest set of other links whose joints,
among themselves and with known ones, are three for each two links (a joint takes two freedoms of three).
"""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

from singsym.kinematics.modules import DrivenModules, driven_modules
from singsym.mechanism import Mechanism, library, load, loads

LEG = Path(__file__).parents[2] / "cases" / "jansen-leg.toml"


def words(mechanism: Mechanism, end: str) -> list[str]:
    return [m.words for m in driven_modules(mechanism)[end].modules]


def parents(found: DrivenModules) -> list[tuple[int, ...]]:
    return [m.parents for m in found.modules]


def test_four_bar() -> None:
    """Two links between the crank pin and the other pivot, whichever end drives."""
    assert words(load("fourbar"), "inputs") == ["crank AB at A", "dyad C from B and D"]
    assert words(load("fourbar"), "outputs") == ["follower CD at D", "dyad B from A and C"]


def test_slider_crank() -> None:
    """Rod and slider hang on a pin and on the slide; driven by the slide, crank and rod hang on two pins."""
    assert words(load("slider-crank"), "inputs") == ["crank AB at A", "slider dyad C from B and P"]
    assert words(load("slider-crank"), "outputs") == ["slide P", "dyad B from A and C"]


def test_five_bar() -> None:
    """Both cranks, then the rods; with C given, each arm by itself."""
    five = load("five-bar")
    assert words(five, "inputs") == ["crank AB at A", "crank DE at E", "dyad C from B and D"]
    assert words(five, "outputs") == ["point C", "dyad B from A and C", "dyad D from C and E"]
    found = driven_modules(five)
    assert parents(found["inputs"]) == [(), (), (0, 1)]
    assert parents(found["outputs"]) == [(), (0,), (0,)]


def test_stephenson_is_two_dyads_or_a_triad() -> None:
    """From the crank: coupler and CD, then EF and FG.

    From FG: AB, coupler, CD and EF are 4 links with the joints A, B, C, D, E, F, and no two of them are a
    dyad: of the three that hang on known pins no two meet.
    """
    six = load("stephenson-six-bar")
    assert words(six, "inputs") == ["crank AB at A", "dyad C from B and D", "dyad F from E and G"]
    assert words(six, "outputs") == ["follower FG at G", "triad B, C and E from A, D and F, 3 unknowns"]
    assert parents(driven_modules(six)["inputs"]) == [(), (0,), (0, 1)]


def test_a_quadrilateral_is_a_group_of_four_links() -> None:
    """Stephenson II: from the crank three rods hold the plate; from DG the loop BCFE hangs on A and G."""
    six = load("stephenson-two-six-bar")
    assert words(six, "inputs") == ["crank at A", "triad C, F and G from B, E and D, 3 unknowns"]
    group = "Assur group of 4 links from A and G, 4 unknowns"
    assert words(six, "outputs") == ["follower DG at D", group]


def test_slotted_levers_are_dyads_though_the_formulation_counts_along_the_slot() -> None:
    """B is on the crank: the block and the slotted link hang on B and D and slide along each other."""
    found = driven_modules(load("whitworth"))["inputs"]
    assert [m.words for m in found.modules] == [
        "crank AB at A",
        "slider dyad P from B and D",
        "slider dyad F from E and Q",
    ]
    crank, dyad, ram = found.modules
    assert (crank.variables, dyad.meets) == (("B.x", "B.y"), ("B.x", "B.y"))
    assert [m.unknowns for m in (crank, dyad, ram)] == [2, 2, 1]


def test_lengths_left_open_change_nothing() -> None:
    """The same linkage with parameters without values."""
    lever = load("crank-slotted-lever")
    names = {p.name: None for p in lever.parameters}
    assert names
    assert words(lever.with_parameters(**names), "inputs") == words(lever, "inputs")
    assert words(lever, "inputs") == ["crank AB at A", "slider dyad P from B and D"]


def test_a_walking_leg() -> None:
    """Jansen's: both knees hang on the crank pin and the fixed pivot, the foot on both."""
    found = driven_modules(load(LEG))["inputs"]
    dyads = ["dyad C from A and B", "dyad D from A and B", "dyad G from D and E"]
    assert [m.words for m in found.modules] == ["crank at O", *dyads]
    assert parents(found) == [(), (0,), (0,), (1, 2)]


@pytest.mark.parametrize("loops", [2, 3, 5])
def test_four_bars_in_series(loops: int) -> None:
    """One dyad after the other, in the order of the loops or against it."""
    points = ", ".join(f"P{i} = [{4 * i}, {i % 2}]" for i in range(loops + 1))
    lines = ['name = "chain"', 'inputs = ["P0"]', f'output = {{ rate = "P{loops}" }}', "[links]"]
    lines += [f"ground = {{ points = {{ {points} }} }}", "P0B1 = 2", f"P{loops}C{loops} = 3"]
    for i in range(1, loops + 1):
        lines.append(f"B{i}C{i} = 4")
        if i < loops:
            lines.append(f"rocker{i} = {{ points = {{ P{i} = [0, 0], C{i} = [3, 0], B{i + 1} = [1, 2] }} }}")
    pins = [*(f"P{i}" for i in range(loops + 1)), *(f"{x}{i}" for i in range(1, loops + 1) for x in "BC")]
    chain = loads("\n".join([*lines, "[joints]", *(f'{pin} = "R"' for pin in pins)]))
    found = driven_modules(chain)
    forth = [f"dyad C{i} from P{i} and B{i}" for i in range(1, loops + 1)]
    back = [f"dyad B{i} from P{i - 1} and C{i}" for i in range(loops, 0, -1)]
    assert [m.words for m in found["inputs"].modules] == ["crank P0B1 at P0", *forth]
    assert [m.words for m in found["outputs"].modules] == [f"follower P{loops}C{loops} at P{loops}", *back]
    for modules in found.values():
        assert parents(modules) == [(), *((i,) for i in range(loops))]


def test_a_parallel_robot_is_one_module_forward_and_a_leg_each_backward() -> None:
    """3-RRR: a platform on three rods is the triad; with the platform given each leg is a dyad."""
    found = driven_modules(load("3rrr"))
    forward, backward = found["inputs"], found["outputs"]
    assert [m.words for m in forward.modules][3] == "triad C1, C2 and C3 from B1, B2 and B3, 3 unknowns"
    assert parents(forward) == [(), (), (), (0, 1, 2)]
    legs = [f"leg {i}: dyad B{i} from A{i} and C{i}" for i in (1, 2, 3)]
    assert [m.words for m in backward.modules] == ["output link platform", *legs]
    assert parents(backward) == [(), (0,), (0,), (0,)]


def test_legs_without_unknowns() -> None:
    """Struts are placed by their ends."""
    assert words(load("3rpr"), "outputs") == ["output link platform, and with it legs 1, 2 and 3"]
    (only,) = driven_modules(load("3rpr"))["inputs"].modules
    assert only.words == "module of 3 unknowns from A1, A2 and A3, driven by P1, P2 and P3"


def test_a_bar_too_many_is_said() -> None:
    """With the crank known, the bar and two cranks are 3 links with 5 joints: 10 equations, 9 unknowns."""
    found = driven_modules(load("double-parallelogram"))["inputs"]
    assert len(found.left_over) == 1
    assert [m.words for m in found.modules] == ["crank AB at A", "module of 1 unknown from B, D and E"]


def test_what_stays_free_is_said() -> None:
    """A five-bar by one crank alone: the other three links are not told."""
    found = driven_modules(replace(load("five-bar"), inputs=("A",)))["inputs"]
    assert [m.words for m in found.modules] == ["crank AB at A"]
    assert set(found.undetermined) == {"Cx", "Cy", "Dx", "Dy"}


@pytest.mark.parametrize("formulation", ["auto", "natural"])
def test_modules_are_square_and_come_after_their_parents(formulation: str) -> None:
    """In all of the library: each variable once, as many equations as variables, parents first."""
    for name in library.names():
        mechanism = load(name)
        try:
            both = driven_modules(mechanism, formulation)
        except ValueError:
            continue
        for found in both.values():
            seen = [*found.undetermined]
            for k, module in enumerate(found.modules):
                given = (*module.equations, *module.driven, *module.meets)
                assert len(module.variables) == len(given), (name, module.words)
                assert all(parent < k for parent in module.parents)
                seen += module.variables
            assert len(seen) == len(set(seen)), name
