"""singsym finds and classifies every singularity of a mechanism, exactly.

Names are imported when they are first used, so that `import singsym` costs nothing.

>>> import singsym
>>> singsym.load("fourbar")
Mechanism('fourbar', 4 links, 4 joints)
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from singsym.certificates.checker.verification import Verification, verify
    from singsym.certificates.prover.writing import Certificate, certificate
    from singsym.classes.classify import Limits, classify, classify_equation
    from singsym.classes.configuration.at import Analysis, MatrixReport, at, at_equation
    from singsym.classes.configuration.given_values import Given
    from singsym.classes.configuration.locate import Located
    from singsym.classes.configuration.null_motions import Motion
    from singsym.classes.configuration.self_motions import SelfMotion, self_motions, self_motions_equation
    from singsym.classes.result import Classification, ClassResult, Configuration, Locus, Piece, SpacePiece
    from singsym.classes.running.runner import Interrupted
    from singsym.classes.solve import Solution, SolutionPiece, solve, solve_equation
    from singsym.classes.taxonomy.types import (
        Defects,
        SingularityClass,
        SingularityType,
        class_of,
        feasible_classes,
    )
    from singsym.conditions.conditions import Condition, Conditions
    from singsym.conditions.factor import Factor
    from singsym.conditions.redundant import RedundantChain, redundant_chain
    from singsym.designs.design import design
    from singsym.designs.result import Cell, Design
    from singsym.designs.sampling import sweep
    from singsym.effort.budget import Budget, BudgetExceeded, Cancelled, Undecided
    from singsym.effort.chance import use_seed
    from singsym.effort.progress import Event
    from singsym.effort.verdict import Answer, Known, Verdict
    from singsym.elimination import engines
    from singsym.elimination.ideal import Ideal
    from singsym.kinematics.mobility import Mobility, check_mobility
    from singsym.kinematics.own_equation import SymbolicSpace, from_sympy
    from singsym.kinematics.placement import ConfigurationSpace, JointValue
    from singsym.kinematics.reduction import Elimination, Reduction, reduce
    from singsym.kinematics.velocity import Column, VelocityEquation, loop_closure, velocity_equation
    from singsym.mechanism import (
        Choice,
        Exclusion,
        Joint,
        JointKind,
        JointRate,
        Limit,
        Link,
        Mechanism,
        MechanismError,
        Parameter,
        PointVelocity,
        Problem,
        Space,
        Twist,
        check,
        define,
        dumps,
        library,
        load,
        loads,
    )
    from singsym.motion.distance import NearSingularity, SingularityDistance, singularity_distance
    from singsym.motion.follow import FollowedMotion, Passage, follow, follow_equation
    from singsym.motion.numeric import NumericLinkage, numeric, numeric_equation
    from singsym.motion.regions.borders import Border
    from singsym.motion.regions.free_box import FreeBox, free_box
    from singsym.motion.regions.joined import Joined, joined
    from singsym.motion.regions.regions import regions, regions_equation
    from singsym.motion.regions.result import Region, Regions
    from singsym.motion.trajectory import Trajectory
    from singsym.output.figures.figure import plot_configuration, plot_mechanism
    from singsym.output.figures.regions import plot_regions
    from singsym.output.figures.self_motions import plot_self_motions
    from singsym.output.figures.style import Picture
    from singsym.output.motion.follow_page import plot_margins
    from singsym.polynomials import Polynomial, PolynomialMatrix, Ring
    from singsym.polynomials.ring import AlgebraicConstant
    from singsym.varieties.constructible import ConstructibleSet
    from singsym.varieties.decomposition import Component, decompose
    from singsym.varieties.real.curves.real_curve import CurveComponent, RealCurve, real_curve
    from singsym.varieties.real.dimension.extent import Extent
    from singsym.varieties.real.points.exact_point import RealPoint

_HOMES = {
    "singsym.certificates.checker.verification": "Verification verify",
    "singsym.certificates.prover.writing": "Certificate certificate",
    "singsym.classes.classify": "Limits classify classify_equation",
    "singsym.classes.configuration.at": "Analysis MatrixReport at at_equation",
    "singsym.classes.configuration.given_values": "Given",
    "singsym.classes.configuration.locate": "Located",
    "singsym.classes.configuration.null_motions": "Motion",
    "singsym.classes.configuration.self_motions": "SelfMotion self_motions self_motions_equation",
    "singsym.classes.result": "Classification ClassResult Configuration Locus Piece SpacePiece",
    "singsym.classes.running.runner": "Interrupted",
    "singsym.classes.solve": "Solution SolutionPiece solve solve_equation",
    "singsym.classes.taxonomy.types": "Defects SingularityClass SingularityType class_of feasible_classes",
    "singsym.conditions.conditions": "Condition Conditions",
    "singsym.conditions.factor": "Factor",
    "singsym.conditions.redundant": "RedundantChain redundant_chain",
    "singsym.designs.design": "design",
    "singsym.designs.result": "Cell Design",
    "singsym.designs.sampling": "sweep",
    "singsym.effort.budget": "Budget BudgetExceeded Cancelled Undecided",
    "singsym.effort.chance": "use_seed",
    "singsym.effort.progress": "Event",
    "singsym.effort.verdict": "Answer Known Verdict",
    "singsym.elimination": "engines",
    "singsym.elimination.ideal": "Ideal",
    "singsym.kinematics.mobility": "Mobility check_mobility",
    "singsym.kinematics.own_equation": "SymbolicSpace from_sympy",
    "singsym.kinematics.placement": "ConfigurationSpace JointValue",
    "singsym.kinematics.reduction": "Elimination Reduction reduce",
    "singsym.kinematics.velocity": "Column VelocityEquation loop_closure velocity_equation",
    "singsym.mechanism": (
        "Choice Exclusion Joint JointKind JointRate Limit Link Mechanism MechanismError Parameter "
        "PointVelocity Problem Space Twist check define dumps library load loads"
    ),
    "singsym.motion.distance": "NearSingularity SingularityDistance singularity_distance",
    "singsym.motion.follow": "FollowedMotion Passage follow follow_equation",
    "singsym.motion.numeric": "NumericLinkage numeric numeric_equation",
    "singsym.motion.regions.borders": "Border",
    "singsym.motion.regions.free_box": "FreeBox free_box",
    "singsym.motion.regions.joined": "Joined joined",
    "singsym.motion.regions.regions": "regions regions_equation",
    "singsym.motion.regions.result": "Region Regions",
    "singsym.motion.trajectory": "Trajectory",
    "singsym.output.figures.figure": "plot_configuration plot_mechanism",
    "singsym.output.figures.regions": "plot_regions",
    "singsym.output.figures.self_motions": "plot_self_motions",
    "singsym.output.figures.style": "Picture",
    "singsym.output.motion.follow_page": "plot_margins",
    "singsym.polynomials": "Polynomial PolynomialMatrix Ring",
    "singsym.polynomials.ring": "AlgebraicConstant",
    "singsym.varieties.constructible": "ConstructibleSet",
    "singsym.varieties.decomposition": "Component decompose",
    "singsym.varieties.real.curves.real_curve": "CurveComponent RealCurve real_curve",
    "singsym.varieties.real.dimension.extent": "Extent",
    "singsym.varieties.real.points.exact_point": "RealPoint",
}
_HOME = {name: home for home, names in _HOMES.items() for name in names.split()}

__all__ = [
    "AlgebraicConstant",
    "Analysis",
    "Answer",
    "Border",
    "Budget",
    "BudgetExceeded",
    "Cancelled",
    "Cell",
    "Certificate",
    "Choice",
    "ClassResult",
    "Classification",
    "Column",
    "Component",
    "Condition",
    "Conditions",
    "Configuration",
    "ConfigurationSpace",
    "ConstructibleSet",
    "CurveComponent",
    "Defects",
    "Design",
    "Elimination",
    "Event",
    "Exclusion",
    "Extent",
    "Factor",
    "FollowedMotion",
    "FreeBox",
    "Given",
    "Ideal",
    "Interrupted",
    "Joined",
    "Joint",
    "JointKind",
    "JointRate",
    "JointValue",
    "Known",
    "Limit",
    "Limits",
    "Link",
    "Located",
    "Locus",
    "MatrixReport",
    "Mechanism",
    "MechanismError",
    "Mobility",
    "Motion",
    "NearSingularity",
    "NumericLinkage",
    "Parameter",
    "Passage",
    "Picture",
    "Piece",
    "PointVelocity",
    "Polynomial",
    "PolynomialMatrix",
    "Problem",
    "RealCurve",
    "RealPoint",
    "Reduction",
    "RedundantChain",
    "Region",
    "Regions",
    "Ring",
    "SelfMotion",
    "SingularityClass",
    "SingularityDistance",
    "SingularityType",
    "Solution",
    "SolutionPiece",
    "Space",
    "SpacePiece",
    "SymbolicSpace",
    "Trajectory",
    "Twist",
    "Undecided",
    "VelocityEquation",
    "Verdict",
    "Verification",
    "at",
    "at_equation",
    "certificate",
    "check",
    "check_mobility",
    "class_of",
    "classify",
    "classify_equation",
    "decompose",
    "define",
    "design",
    "dumps",
    "engines",
    "feasible_classes",
    "follow",
    "follow_equation",
    "free_box",
    "from_sympy",
    "joined",
    "library",
    "load",
    "loads",
    "loop_closure",
    "numeric",
    "numeric_equation",
    "plot_configuration",
    "plot_margins",
    "plot_mechanism",
    "plot_regions",
    "plot_self_motions",
    "real_curve",
    "reduce",
    "redundant_chain",
    "regions",
    "regions_equation",
    "self_motions",
    "self_motions_equation",
    "singularity_distance",
    "solve",
    "solve_equation",
    "sweep",
    "use_seed",
    "velocity_equation",
    "verify",
]


def __getattr__(name: str) -> Any:
    """A public name, imported from its home; some are modules."""
    if name not in _HOME:
        raise AttributeError(f"module 'singsym' has no attribute {name!r}")
    home = import_module(_HOME[name])
    value = getattr(home, name) if hasattr(home, name) else import_module(f"{_HOME[name]}.{name}")
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})
