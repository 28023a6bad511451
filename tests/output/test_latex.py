"""The LaTeX documents, by a real TeX: they compile, and no box is too wide."""

import re
import shutil
import subprocess

import pytest

from singsym.classes.classify import classify
from singsym.classes.solve import solve
from singsym.classes.taxonomy.types import table
from singsym.conditions.conditions import conditions
from singsym.kinematics.velocity import velocity_equation
from singsym.mechanism import define, load
from singsym.output.document import document, escaped, fragment
from singsym.output.latex import (
    classes_latex,
    classification_latex,
    conditions_latex,
    mechanism_latex,
    solution_latex,
)

needs_tex = pytest.mark.skipif(shutil.which("pdflatex") is None, reason="pdflatex is not installed")


def typeset(body, folder, title="Title"):
    (folder / "d.tex").write_text(document(body, title), encoding="utf-8")
    compiled(folder)


def compiled(folder):
    done = subprocess.run(
        ["pdflatex", "-halt-on-error", "-interaction=nonstopmode", "d.tex"],
        cwd=folder,
        capture_output=True,
        check=False,
    )
    log = (folder / "d.log").read_text(encoding="latin-1")
    assert done.returncode == 0, log[-2000:]
    assert "Overfull" not in log
    assert "Missing character" not in log
    assert (folder / "d.pdf").exists()


@needs_tex
@pytest.mark.parametrize("name", ["puma560", "3rpr", "stewart-gough"])
def test_conditions_compile(name, tmp_path):
    mechanism = load(name)
    typeset(conditions_latex(conditions(velocity_equation(mechanism)), mechanism), tmp_path)


def inputted(body, folder):
    r"""A fragment by \input in a plain article with the packages that its first line names, and no others."""
    text = fragment(body)
    packages = re.fullmatch(r"% .*\\usepackage\{(.*)\}", text.splitlines()[0])[1]
    (folder / "f.tex").write_text(text, encoding="utf-8")
    head = rf"\documentclass{{article}}\usepackage{{{packages}}}"
    (folder / "d.tex").write_text(
        f"{head}\\begin{{document}}\nBefore.\\input{{f}}\nAfter.\\end{{document}}\n", encoding="utf-8"
    )
    compiled(folder)


@needs_tex
@pytest.mark.parametrize("name", ["zlatanov-2dof", "zlatanov-hybrid"])
def test_fragments_work_in_a_plain_article(name, tmp_path):
    mechanism = load(name)
    inputted(conditions_latex(conditions(velocity_equation(mechanism)), mechanism), tmp_path)


def test_fragments_use_no_more_than_they_say(tmp_path):
    """Without a TeX too: braces and environments are closed, and commands are of LaTeX or the packages."""
    mechanism = load("zlatanov-2dof")
    text = fragment(conditions_latex(conditions(velocity_equation(mechanism)), mechanism))
    assert text.startswith("% For \\input; the document needs \\usepackage{amsmath,array,booktabs}\n")
    bare = re.sub(r"\\[{}]", "", text)
    assert bare.count("{") == bare.count("}")
    environments = re.findall(r"\\(begin|end)\{(\w+)\}", text)
    for kind in {name for _, name in environments}:
        assert environments.count(("begin", kind)) == environments.count(("end", kind))
    assert not re.search(r"\\(fitted|resizebox|includegraphics|mathbb)\b", text)


@needs_tex
def test_classification_and_solution_compile(tmp_path):
    mechanism = load("slider-crank")
    body = classification_latex(classify(mechanism, cache=False))
    typeset(body, tmp_path)
    inputted(body, tmp_path)
    typeset(solution_latex(solve(mechanism, "4", "5", "i", "vi", cache=False)), tmp_path)


@needs_tex
def test_tables_and_mechanisms_compile(tmp_path):
    typeset("\n\n".join(classes_latex(table(n), n) for n in (1, 2, 3)), tmp_path)
    mechanism = load("bennett")
    typeset(mechanism_latex(mechanism, velocity_equation(mechanism)), tmp_path)


@needs_tex
def test_hostile_text_is_only_text(tmp_path):
    r"""Names and descriptions come from files: a \input in one must not be obeyed."""
    text = "50 % of #1 & $x_1^2$ ~ {a} \\input{/etc/passwd} <ü> 漢"
    mechanism = define(
        name="arm",
        title=text,
        description=text,
        inputs=["A", "B"],
        output={"velocity": "C"},
        links={"ground": {"points": {"A": [0, 0]}}, "AB": 1, "BC": "1/2"},
        joints={"A": "R", "B": "R"},
    )
    typeset(mechanism_latex(mechanism, velocity_equation(mechanism)), tmp_path, mechanism.title)
    assert r"\textbackslash{}input\{" in escaped(text)


def test_factors_are_written_as_determinants_of_points():
    found = conditions_latex(conditions(velocity_equation(load("zlatanov-2dof"))))
    assert r"\det[S_{B}\, S_{C}\, S_{D}] = " in found
    assert "B, C, D collinear" in found
