"""Values as JSON and back, led by type hints alone: nothing is read that the hints do not name.

Source: codecs derived from types, as in msgspec and cattrs (msgspec refuses unions of dataclasses and takes
`Any` as it comes, cattrs turns "3" into 3).  Records and polynomials are written once each, as in pickle's
memo, but found equal by value: equal values have equal texts.
"""

from __future__ import annotations

import dataclasses
import hashlib
import re
from abc import ABC, abstractmethod
from collections.abc import Mapping
from contextlib import suppress
from dataclasses import dataclass
from enum import Enum
from functools import cache, cached_property
from types import NoneType, UnionType
from typing import Any, Literal, Union, get_args, get_origin, get_type_hints

from singsym.classes.running.plain_forms import FORMS

_WORD = 1 << 63
"""Integers from here on are written in hexadecimal, which takes time linear in their length."""


class Mismatch(ValueError):
    """A value, or data read, that is not of the declared type."""


def encode(value: Any, hint: Any) -> dict[str, Any]:
    """Plain data for `json.dumps` of a value of the type `hint`.

    Raises `Mismatch` where the value, or a part of it, is of another type, and `TypeError` for a type that
    has no codec.

    >>> from fractions import Fraction
    >>> encode((Fraction(1, 2), None), tuple[Fraction, int | None])
    {'shared': [(1, 2)], 'value': (0, None)}
    """
    writer = Writer()
    written = codec(hint).write(value, writer)
    return {"shared": writer.table, "value": written}


def decode(data: Any, hint: Any) -> Any:
    """The value of the type `hint` that was encoded; raises `Mismatch`, or what the type itself raises.

    >>> from fractions import Fraction
    >>> decode({"shared": [[1, 2]], "value": [0, None]}, tuple[Fraction, int | None])
    (Fraction(1, 2), None)
    >>> decode({"shared": [], "value": "1"}, int)
    Traceback (most recent call last):
    ...
    singsym.classes.running.json_codec.Mismatch: '1' is no int
    """
    if not isinstance(data, dict) or set(data) != {"shared", "value"}:
        raise Mismatch("expected shared values and a value")
    return codec(hint).read(data["value"], Reader(_list(data["shared"])))


def shape(hint: Any) -> str:
    """A digest of all records that a value of the type `hint` may hold: their fields and types, in order.

    What was written under another one is not to be read: places in lists would mean other things.  Where in
    the program a type is does not matter.
    """
    found: dict[type, str] = {}
    waiting = [hint]
    while waiting:
        part = waiting.pop()
        waiting += get_args(FORMS[part].hint if part in FORMS else part)
        if isinstance(part, type) and part not in FORMS and part not in found and _fields(part):
            hints = get_type_hints(part)
            found[part] = f"{part.__qualname__}: {[(name, hints[name]) for name in _fields(part)]}"
            waiting += [hints[name] for name in _fields(part)]
    text = re.sub(r"\b(\w+\.)+", "", "\n".join(sorted(found.values())))
    return hashlib.sha256(text.encode()).hexdigest()[:16]


class Writer:
    """The table of the shared values written so far; each refers only to those before it."""

    def __init__(self) -> None:
        self.table: list[Any] = []
        self._places: dict[tuple[Shared, Any], int] = {}
        self._seen: dict[tuple[Shared, int], tuple[int, Any]] = {}

    def place(self, codec: Shared, value: Any) -> int:
        """Where a value stands in the table."""
        identity = codec, id(value)
        if identity not in self._seen:
            parts = codec.take_apart(value, self)
            place = self._places.setdefault((codec, parts), len(self.table))
            if place == len(self.table):
                self.table.append(parts)
            # with the value itself, so that nothing else gets its identity
            self._seen[identity] = place, value
        return self._seen[identity][0]


class Reader:
    """The same table on the way back; equal references give the same object."""

    def __init__(self, table: list[Any]) -> None:
        self.table = table
        self._limit = len(table)
        self._known: dict[tuple[Shared, int], Any] = {}

    def value(self, codec: Shared, place: Any) -> Any:
        """The value at a place, which must come before the one being read."""
        if type(place) is not int or not 0 <= place < self._limit:
            raise Mismatch(f"{place!r} refers to no value before it")
        if (codec, place) not in self._known:
            limit, self._limit = self._limit, place
            self._known[codec, place] = codec.put_together(self.table[place], self)
            self._limit = limit
        return self._known[codec, place]


class Codec(ABC):
    """How values of one type are written and read."""

    @abstractmethod
    def write(self, value: Any, writer: Writer) -> Any:
        """Plain data, with tuples for JSON's arrays."""

    @abstractmethod
    def read(self, data: Any, reader: Reader) -> Any:
        """The value again, from lists for arrays."""


@cache
def codec(hint: Any) -> Codec:
    """The codec of a type, as `typing.get_type_hints` gives it; raises `TypeError` where there is none.

    `Any` admits only None: what is not declared is not kept.
    """
    origin, arguments = get_origin(hint), get_args(hint)
    if hint in (Any, NoneType):
        return _Exact(NoneType)
    if hint in _EXACT:
        return _EXACT[hint]
    if hint in FORMS:
        return _Formed(hint)
    if origin is Literal:
        return _Choice(arguments)
    if origin in (Union, UnionType):
        members = tuple(codec(member) for member in arguments if member is not NoneType)
        return _Either(members, optional=NoneType in arguments)
    if origin is tuple and arguments[1:] == (...,):
        return _Sequence(codec(arguments[0]))
    if origin is tuple:
        return _Row(tuple(map(codec, arguments)))
    if origin is not None and issubclass(origin, Mapping):
        return _Table(_Sequence(_Row(tuple(map(codec, arguments)))))
    if isinstance(hint, type) and issubclass(hint, Enum):
        return _Member(hint)
    if _fields(hint):
        return _Record(hint)
    raise TypeError(f"{hint!r} is no type of numbers, text, polynomials, and tuples or records of them")


def _fields(hint: Any) -> tuple[str, ...]:
    """The fields of a frozen dataclass or a named tuple, in order; none for other types."""
    if not isinstance(hint, type):
        return ()
    if issubclass(hint, tuple):
        return tuple(getattr(hint, "_fields", ()))
    if dataclasses.is_dataclass(hint) and hint.__dataclass_params__.frozen:  # type: ignore[attr-defined]
        return tuple(field.name for field in dataclasses.fields(hint))
    return ()


def _list(data: Any, length: int | None = None) -> list[Any]:
    if type(data) is not list or length not in (None, len(data)):
        raise Mismatch(f"expected a list{'' if length is None else f' of {length}'}")
    return data


@dataclass(frozen=True)
class _Exact(Codec):
    """Text, truth values and None: JSON has them."""

    type: type

    def write(self, value: Any, writer: Writer) -> Any:
        return self._same(value)

    def read(self, data: Any, reader: Reader) -> Any:
        return self._same(data)

    def _same(self, value: Any) -> Any:
        if type(value) is not self.type:
            raise Mismatch(f"{value!r} is no {self.type.__name__}")
        return value


class _Integer(Codec):
    """Whole numbers of any length."""

    def write(self, value: Any, writer: Writer) -> Any:
        if type(value) is not int:
            raise Mismatch(f"{value!r} is no int")
        return value if -_WORD <= value < _WORD else hex(value)

    def read(self, data: Any, reader: Reader) -> Any:
        value = int(data, 16) if type(data) is str else data
        if type(value) is not int or self.write(value, Writer()) != data:
            raise Mismatch(f"{data!r} is no int")
        return value


class _Float(Codec):
    """Floats, exactly; whole numbers may stand for them."""

    def write(self, value: Any, writer: Writer) -> Any:
        if type(value) not in (float, int):
            raise Mismatch(f"{value!r} is no float")
        return float(value).hex()

    def read(self, data: Any, reader: Reader) -> Any:
        if type(data) is not str:
            raise Mismatch(f"{data!r} is no float")
        return float.fromhex(data)


_EXACT: dict[Any, Codec] = {
    str: _Exact(str),
    bool: _Exact(bool),
    int: _Integer(),
    float: _Float(),
}


@dataclass(frozen=True)
class _Choice(Codec):
    """One of some words."""

    choices: tuple[Any, ...]

    def write(self, value: Any, writer: Writer) -> Any:
        return self._same(value)

    def read(self, data: Any, reader: Reader) -> Any:
        return self._same(data)

    def _same(self, value: Any) -> Any:
        if type(value) is not str or value not in self.choices:
            raise Mismatch(f"{value!r} is none of {self.choices}")
        return value


@dataclass(frozen=True)
class _Member(Codec):
    """A member of an enumeration, or a combination of flags, as its value."""

    type: type[Enum]

    def write(self, value: Any, writer: Writer) -> Any:
        if type(value) is not self.type:
            raise Mismatch(f"{value!r} is no {self.type.__name__}")
        return value.value

    def read(self, data: Any, reader: Reader) -> Any:
        value = self.type(data)
        if type(data) is not type(value.value) or data != value.value:
            raise Mismatch(f"{data!r} is no value of {self.type.__name__}")
        return value


@dataclass(frozen=True)
class _Either(Codec):
    """A union: null for None, else the number of the first type that admits the value, and its data."""

    members: tuple[Codec, ...]
    optional: bool

    def write(self, value: Any, writer: Writer) -> Any:
        if value is None and self.optional:
            return None
        for place, member in enumerate(self.members):
            with suppress(Mismatch):
                return place, member.write(value, writer)
        raise Mismatch(f"{value!r} is of no type of a union")

    def read(self, data: Any, reader: Reader) -> Any:
        if data is None and self.optional:
            return None
        place, inside = _list(data, 2)
        if type(place) is not int or not 0 <= place < len(self.members):
            raise Mismatch(f"there is no type number {place!r}")
        return self.members[place].read(inside, reader)


@dataclass(frozen=True)
class _Sequence(Codec):
    """A tuple of any length, of one type."""

    item: Codec

    def write(self, value: Any, writer: Writer) -> Any:
        if type(value) is not tuple:
            raise Mismatch(f"{value!r} is no tuple")
        return tuple(self.item.write(part, writer) for part in value)

    def read(self, data: Any, reader: Reader) -> Any:
        return tuple(self.item.read(part, reader) for part in _list(data))


@dataclass(frozen=True)
class _Row(Codec):
    """A tuple with a type for each place."""

    items: tuple[Codec, ...]

    def write(self, value: Any, writer: Writer) -> Any:
        if type(value) is not tuple or len(value) != len(self.items):
            raise Mismatch(f"{value!r} is no tuple of {len(self.items)}")
        return tuple(item.write(part, writer) for item, part in zip(self.items, value, strict=True))

    def read(self, data: Any, reader: Reader) -> Any:
        parts = zip(self.items, _list(data, len(self.items)), strict=True)
        return tuple(item.read(part, reader) for item, part in parts)


@dataclass(frozen=True)
class _Table(Codec):
    """A mapping, as pairs in its own order; it comes back as a dict."""

    pairs: Codec

    def write(self, value: Any, writer: Writer) -> Any:
        if not isinstance(value, Mapping):
            raise Mismatch(f"{value!r} is no mapping")
        return self.pairs.write(tuple(value.items()), writer)

    def read(self, data: Any, reader: Reader) -> Any:
        pairs = self.pairs.read(data, reader)
        if len(found := dict(pairs)) != len(pairs):
            raise Mismatch("a key comes twice")
        return found


class Shared(Codec):
    """Values that stand in the table."""

    def write(self, value: Any, writer: Writer) -> Any:
        """The JSON of a value of this type."""
        return writer.place(self, value)

    def read(self, data: Any, reader: Reader) -> Any:
        """The value that JSON stands for; raises `ValueError` for anything else."""
        return reader.value(self, data)

    @abstractmethod
    def take_apart(self, value: Any, writer: Writer) -> Any:
        """What stands in the table for a value."""

    @abstractmethod
    def put_together(self, data: Any, reader: Reader) -> Any:
        """The value that it stands for."""


@dataclass(frozen=True)
class _Record(Shared):
    """A frozen dataclass or a named tuple: all its fields in order, also those that are not compared."""

    type: type

    @cached_property
    def codecs(self) -> dict[str, Codec]:
        hints = get_type_hints(self.type)
        return {name: codec(hints[name]) for name in _fields(self.type)}

    def take_apart(self, value: Any, writer: Writer) -> Any:
        if type(value) is not self.type:
            raise Mismatch(f"{value!r} is no {self.type.__name__}")
        return tuple(field.write(getattr(value, name), writer) for name, field in self.codecs.items())

    def put_together(self, data: Any, reader: Reader) -> Any:
        parts = zip(self.codecs.items(), _list(data, len(self.codecs)), strict=True)
        return self.type(**{name: field.read(part, reader) for (name, field), part in parts})


@dataclass(frozen=True)
class _Formed(Shared):
    """A type that is written in its plain form; only what has exactly this form again is read."""

    type: type

    def take_apart(self, value: Any, writer: Writer) -> Any:
        if type(value) is not self.type:
            raise Mismatch(f"{value!r} is no {self.type.__name__}")
        form = FORMS[self.type]
        return codec(form.hint).write(form.plain(value), writer)

    def put_together(self, data: Any, reader: Reader) -> Any:
        form = FORMS[self.type]
        plain = codec(form.hint).read(data, reader)
        value = form.made(plain)
        if form.plain(value) != plain:
            raise Mismatch(f"{plain!r} is not how a {self.type.__name__} is written")
        return value
