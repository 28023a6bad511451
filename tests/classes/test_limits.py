"""Singular configurations that lie on a limit, which a closed range contains.

The knee: link b from the origin to o_j3, link c from there to the tool, both of length 1.  As z_j3 is
parallel to z_j2, the velocities of the tool are dependent exactly where the knee is stretched or folded
(sin j3 = 0) or the tool is on the axis z_j1, the usual elbow and shoulder singularities; the first is
stretched at j3 = 0, the lower end of the range, with j1 and j2 free: dimension 2.
"""

from pathlib import Path

import pytest

from singsym.classes.classify import classify
from singsym.classes.configuration.at import at
from singsym.classes.solve import solve
from singsym.conditions.conditions import conditions
from singsym.kinematics.velocity import velocity_equation
from singsym.mechanism import Mechanism, loads
from singsym.mechanism.urdf import from_urdf
from singsym.mechanism.writer import dumps

KNEE = Path(__file__).parent.parent / "cases" / "knee.urdf"
STRETCHED = "elbow: arm stretched or folded, tool in the plane of the axes j2 and j3"


def knee(kind: str, lower: str, upper: str, tmp_path: Path) -> Mechanism:
    """The knee with another joint or range."""
    text = KNEE.read_text(encoding="utf-8").replace(
        'lower="0" upper="2.5"', f'lower="{lower}" upper="{upper}"'
    )
    file = tmp_path / "knee.urdf"
    file.write_text(text.replace('"j3" type="revolute"', f'"j3" type="{kind}"'), encoding="utf-8")
    return from_urdf(file)


def test_the_stretched_knee_is_found_by_all_commands() -> None:
    arm = from_urdf(KNEE)
    equation = velocity_equation(arm)
    words = [f.words for f in conditions(equation)["5"].factors]
    assert words == [STRETCHED, "shoulder: tool on the axis j1"]
    loci = {locus.words: locus for locus in classify(arm, cache=False).loci}
    assert [loci[w].dimension for w in words] == [2, 2]
    (solution,) = solve(arm, "5", cache=False)
    assert sorted(piece.dimension for piece in solution.pieces) == [2, 2]
    stretched = at(arm, {"joints": {"j1": 0, "j2": 1, "j3": 0}})
    assert stretched.singularity_class.number == 1
    assert stretched.remarks == ()


@pytest.mark.parametrize(
    ("lower", "upper", "dimension"),
    [
        ("-2.5", "0", 2),
        ("0", "1.5708", 2),
        ("0.01", "2.5", -1),
        ("0.6", "3.1416", 2),
        ("1.57", "3.1415", 2),
        ("0.6", "3.1", -1),
        ("-3.5", "3.5", 2),
        ("0", "6.28", 2),
        ("3.3", "6.28", 2),
        ("0", "0", 2),
    ],
)
def test_stretched_and_folded_knees(lower: str, upper: str, dimension: int, tmp_path: Path) -> None:
    """sin j3 = 0 at 0, pi and 2 pi; a range that ends there, to the digits given, contains it."""
    locus = classify(knee("revolute", lower, upper, tmp_path), cache=False).loci[0]
    assert locus.words == STRETCHED
    assert locus.dimension == dimension


@pytest.mark.parametrize(("angles", "dimension"), [("[30, 90]", -1), ("[90, 180]", 2), ("[0, 45]", 2)])
def test_degrees_of_a_file(angles: str, dimension: int) -> None:
    text = dumps(from_urdf(KNEE)).partition("[limits]")[0]
    locus = classify(loads(f'{text}[limits]\n"angle(j3)" = {angles}\n'), cache=False).loci[0]
    assert (locus.words, locus.dimension) == (STRETCHED, dimension)


@pytest.mark.parametrize(
    ("lower", "upper", "dimensions"),
    [("0", "0.7", [2, 2]), ("-0.7", "0", [2, 2]), ("0.001", "0.7", [2]), ("-1", "inf", [2, 2])],
)
def test_a_slide(lower: str, upper: str, dimensions: list[int], tmp_path: Path) -> None:
    """With a slide along y for j3 the tool is at (2, s, 0) in link b, and det L_O is 2 s cos j2 up to a
    sign: columns (-s, 2 cos j2, 0), (-2 sin j2, 0, -2 cos j2) and (0, 1, 0).  From .001 on s is no factor."""
    arm = knee("prismatic", lower, upper, tmp_path)
    assert sorted(locus.dimension for locus in classify(arm, cache=False).loci) == dimensions
