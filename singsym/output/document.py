"""A LaTeX document around the LaTeX of a result, a fragment for one's own, and text that is safe in them.

Source: singsym's own; amsmath, array and booktabs.
"""

from __future__ import annotations

PACKAGES = "amsmath,array,booktabs"
"""What the LaTeX of a result needs."""

_PREAMBLE = r"""\documentclass[a4paper,10pt]{article}
\usepackage[T1]{fontenc}
\usepackage[utf8]{inputenc}
\usepackage{lmodern}
\usepackage[margin=22mm]{geometry}
\usepackage{%s}
\relpenalty=50 \binoppenalty=100 \emergencystretch=3em
\lineskiplimit=1pt \lineskip=2pt
\setlength{\parindent}{0pt} \setlength{\parskip}{3pt plus 1pt}
\raggedright
\makeatletter\def\@listI{\leftmargin\leftmargini \topsep2pt \parsep0pt \itemsep3pt}
\let\@listi\@listI \@beginparpenalty=10000 \makeatother
\setlength{\tabcolsep}{5pt}
"""

_SPECIAL = str.maketrans(
    {
        "\\": r"\textbackslash{}",
        "{": r"\{",
        "}": r"\}",
        "&": r"\&",
        "%": r"\%",
        "$": r"\$",
        "#": r"\#",
        "_": r"\_",
        "~": r"\textasciitilde{}",
        "^": r"\textasciicircum{}",
        "<": r"\textless{}",
        ">": r"\textgreater{}",
        "≈": r"$\approx$",
    }
)


def escaped(text: str) -> str:
    """Text from a file or a message as LaTeX text; what the fonts lack becomes a question mark.

    >>> print(escaped("50 % of A_1 & B"))
    50 \\% of A\\_1 \\& B
    >>> print(escaped("J ≈ 2 €"))
    J $\\approx$ 2 ?
    """
    known = (c if c.isprintable() and (ord(c) < 0x180 or c == "≈") else "?" for c in " ".join(text.split()))
    kept = "".join(known)
    return kept.translate(_SPECIAL)


def document(body: str, title: str) -> str:
    """A whole document around the LaTeX of a result."""
    head = f"{{\\LARGE\\bfseries {escaped(title)}\\par}}\\bigskip"
    preamble = _PREAMBLE.replace("%s", PACKAGES)
    return f"{preamble}\\begin{{document}}\n{head}\n\n{body}\n\\end{{document}}"


def fragment(body: str) -> str:
    """The LaTeX of a result for \\input in a document of one's own; its first line names the packages.

    >>> print(fragment("$x$").splitlines()[0])
    % For \\input; the document needs \\usepackage{amsmath,array,booktabs}
    """
    # long formulas would stick out of justified lines, and wide tables out of narrow pages
    setting = r"\begingroup\raggedright\emergencystretch=3em\relpenalty=50\binoppenalty=100\tabcolsep=3pt"
    return f"% For \\input; the document needs \\usepackage{{{PACKAGES}}}\n{setting}\n{body}\n\\par\\endgroup"
