"""In which step of the procedure each class is found or shown to be empty.

Source: Zlatanov, Fenton, Benhabib (1998), section 3.2, steps (1)-(6), as Table 2 records them.
"""

from __future__ import annotations

from collections.abc import Iterable

from singsym.classes.taxonomy.types import SingularityType

_T = SingularityType
_IMPOSSIBLE = _T.II | _T.IO
_REDUNDANT = _T.RI | _T.RO


def found_in(types: SingularityType) -> str:
    """The step that yields a class of these types.

    >>> found_in(SingularityType.RO | SingularityType.II)
    '6'
    >>> found_in(SingularityType.RPM | SingularityType.IIM)
    '3.3'
    """
    if _T.IIM in types:
        return "3.3" if _T.RPM in types else "3.4"
    return "3.5" if _T.RPM in types else "6"


def excluded_in(types: SingularityType, occurring: Iterable[SingularityType]) -> str:
    """The first step after which a class of these types cannot occur, given those that do.

    >>> excluded_in(SingularityType.IIM | SingularityType.RPM, [SingularityType.RO | SingularityType.II])
    '1'
    """
    present = tuple(occurring)
    increased = [t for t in present if _T.IIM in t]
    passive = [t for t in present if _T.RPM in t]
    if _T.IIM in types:
        if not increased:
            return "1"
        if all(t & _IMPOSSIBLE != types & _IMPOSSIBLE for t in increased):
            return "3.1"
    if _T.RPM in types:
        if not passive:
            return "2"
        if all(t & _REDUNDANT != types & _REDUNDANT for t in passive):
            return "3.2"
    if not types & (_T.IIM | _T.RPM):
        if _T.RO in types and not any(_T.RO in t or _T.RPM in t for t in present):
            return "4"
        if _T.RI in types and not any(_T.RI in t or _T.RPM in t for t in present):
            return "5"
    return found_in(types)
