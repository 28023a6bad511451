"""Reports in a real browser: they turn by keyboard, play, are dark or narrow, load nothing."""

from __future__ import annotations

import shutil
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from singsym.classes.classify import classify
from singsym.mechanism import load

api = pytest.importorskip("playwright.sync_api", reason="needs the Python package playwright")
CHROMIUM = shutil.which("chromium") or shutil.which("chromium-browser") or shutil.which("google-chrome")
FLAGS = (
    "--no-sandbox --disable-gpu --disable-quic --no-first-run --disable-sync "
    "--disable-background-networking --disable-component-update"
)
pytestmark = [
    pytest.mark.skipif(
        CHROMIUM is None, reason="no Chromium: none of chromium, chromium-browser, google-chrome"
    ),
    pytest.mark.xdist_group("browser"),
]


@pytest.fixture(scope="module")
def reports(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A plane mechanism with curves over its inputs, and an arm in space."""
    folder = tmp_path_factory.mktemp("reports")
    for name in ("five-bar", "orthogonal-3r"):
        classify(load(name), cache=False).report(folder / f"{name}.html")
    return folder


@pytest.fixture(scope="module")
def browser() -> Iterator[Any]:
    with api.sync_playwright() as started:
        running = started.chromium.launch(executable_path=CHROMIUM, args=FLAGS.split())
        yield running
        running.close()


class Shown:
    """A report in a page of the browser, with what it says on the console and what it asks for."""

    def __init__(self, browser: Any, file: Path, **settings: Any) -> None:
        self.page = browser.new_page(**settings)
        self.said: list[str] = []
        self.asked: list[str] = []
        self.page.on("console", lambda message: self.said.append(message.text))
        self.page.on("pageerror", lambda error: self.said.append(str(error)))
        self.page.on("request", lambda request: self.asked.append(request.url))
        self.page.goto(file.as_uri())

    def drawn(self, scene: str) -> str:
        """The shapes of a scene as they are."""
        return str(self.page.locator(f"{scene} svg > g").inner_html())


@pytest.mark.parametrize("name", ["five-bar", "orthogonal-3r"])
@pytest.mark.parametrize("scheme", ["light", "dark"])
@pytest.mark.parametrize("width", [390, 1200])
def test_nothing_is_wrong_loaded_or_too_wide(
    browser: Any, reports: Path, name: str, scheme: str, width: int
) -> None:
    file = reports / f"{name}.html"
    shown = Shown(browser, file, color_scheme=scheme, viewport={"width": width, "height": 800})
    assert shown.said == []
    assert shown.asked == [file.as_uri()]
    assert shown.page.evaluate("document.documentElement.scrollWidth") <= width
    paper = shown.page.evaluate("getComputedStyle(document.body).backgroundColor")
    assert (sum(int(x) for x in paper[4:-1].split(",")) < 384) == (scheme == "dark")
    link = shown.page.locator(".scene polyline.bar").first.evaluate("e => getComputedStyle(e).stroke")
    assert link != paper
    shown.page.close()


def test_an_arm_turns_by_keyboard_and_by_dragging_and_turns_back(browser: Any, reports: Path) -> None:
    shown = Shown(browser, reports / "orthogonal-3r.html")
    scene = shown.page.locator(".scene svg[tabindex='0']").first
    before = shown.drawn("header .scene")
    scene.focus()
    for key in ("ArrowRight", "ArrowUp", "ArrowLeft", "ArrowDown"):
        now = shown.drawn("header .scene")
        shown.page.keyboard.press(key)
        assert shown.drawn("header .scene") != now, key
    shown.page.keyboard.press("Home")
    assert shown.drawn("header .scene") == before
    box = scene.bounding_box()
    shown.page.mouse.move(box["x"] + 200, box["y"] + 150)
    shown.page.mouse.down()
    shown.page.mouse.move(box["x"] + 260, box["y"] + 150)
    shown.page.mouse.up()
    assert shown.drawn("header .scene") != before
    assert shown.said == []
    shown.page.close()


def test_a_null_motion_plays_and_stops_by_keyboard(browser: Any, reports: Path) -> None:
    shown = Shown(browser, reports / "orthogonal-3r.html")
    button = shown.page.locator("#class-1 .scene button")
    before = shown.drawn("#class-1 .scene")
    button.focus()
    shown.page.keyboard.press("Enter")
    assert button.inner_text() == "Pause"
    shown.page.wait_for_function(
        "before => document.querySelector('#class-1 .scene svg > g').innerHTML !== before", arg=before
    )
    shown.page.keyboard.press("Enter")
    assert button.inner_text() == "Play"
    stopped = shown.drawn("#class-1 .scene")
    shown.page.wait_for_timeout(300)
    assert shown.drawn("#class-1 .scene") == stopped
    shown.page.close()


def test_a_configuration_on_a_curve_is_marked_on_that_curve_of_both_plots(
    browser: Any, reports: Path
) -> None:
    """The mark is on the stroke of a drawn curve, at each of some places of each track."""
    shown = Shown(browser, reports / "five-bar.html")
    scene = shown.page.locator("#curves .scene")
    tracks = scene.locator("option").count()
    assert tracks >= 3
    for track in range(tracks):
        scene.locator("select").select_option(str(track))
        for place in ("3", "10"):
            scene.locator("input").fill(place)
            assert "A = " in scene.locator("output").inner_text()
            on_curves = shown.page.evaluate(
                """() => [...document.querySelectorAll('circle.here')].map(mark => {
                  const [x, y] = [mark.cx.baseVal.value, mark.cy.baseVal.value];
                  const curves = [...mark.ownerSVGElement.querySelectorAll('path[clip-path]')];
                  return mark.getAttribute('visibility') === 'visible' && curves.some(curve => {
                    curve.style.strokeWidth = '4';
                    return curve.isPointInStroke(new DOMPoint(x, y));
                  });
                })"""
            )
            assert on_curves == [True, True], (track, place)
    shown.page.close()
