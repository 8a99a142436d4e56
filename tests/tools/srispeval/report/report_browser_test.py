# SPDX-License-Identifier: Apache-2.0
"""The report of srispeval in a browser, used as a person would: by keyboard, without scripts, in the dark, on paper.

Usage: report_browser_test.py MAKE_REPORT [FOLDER]; screenshots go into FOLDER.
"""
import base64
import subprocess
import sys
import tempfile
from pathlib import Path

sys.dont_write_bytecode = True  # the folder of sources stays clean
from browser_page import Page, canvas, check, developed, finish, linear_file, linear_of, same, srgb

import numpy as np
from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys

HOSTILE = "<script>alert(1)</script>.dng"


def column(page, number):
    return page.js("return [...document.querySelector('.sortable').tBodies[0].rows]"
                   ".map(row => row.cells[arguments[0]].textContent.trim())", number)


def test_sorting(page):
    heads = page.all(".sortable thead tr:last-child th")
    before = column(page, 0)
    check("the table begins in its order", before == [str(i + 1) for i in range(len(before))], before[:5])
    for number in (0, 5, 7, 10, 13):
        for direction in ("ascending", "descending"):
            button = heads[number].find_element(By.TAG_NAME, "button")
            page.js("arguments[0].focus()", button)
            page.press(Keys.ENTER if direction == "ascending" or number % 2 else Keys.SPACE)
            want = direction if number or direction == "descending" else "descending"
            if number == 0 and direction == "descending":
                want = "ascending"  # it was sorted by its rank already
            check(f"column {number} says that it is {want}", heads[number].get_attribute("aria-sort") == want,
                  heads[number].get_attribute("aria-sort"))
            texts = column(page, number)
            values = [float(text.replace("−", "-")) for text in texts if text != "–"]
            check(f"column {number} is {want}", values == sorted(values, reverse=want == "descending"), values[:6])
            check(f"column {number} misses some, or none", ("–" in texts) == (number == 13), texts[-9:])
            check(f"column {number} has what is missing last", "–" not in texts[:len(values)], texts)
    check("one column alone is the sorted one", len(page.all(".sortable th[aria-sort]")) == 1)
    page.js("arguments[0].click()", heads[1].find_element(By.TAG_NAME, "button"))
    names = column(page, 1)
    check("names are sorted", names.index("shoot0/_DSC1000.dng") < names.index("shoot4/_DSC1148.dng"), names[:5])
    page.js("arguments[0].click()", heads[0].find_element(By.TAG_NAME, "button"))
    check("the first order comes back", column(page, 0) == before)


def open_viewer(page):
    link = page.find(".sortable tbody a")
    page.js("arguments[0].focus()", link)
    page.press(Keys.ENTER)
    page.wait("the viewer opens", lambda: "Image 1 of" in page.text("#viewer-state"))
    return link.get_attribute("href").split("#")[1]


def chosen(page):
    return page.js("return document.querySelector('#viewer-choice input:checked').parentElement.textContent.trim()"
                   ".replace(/^[0-9]+ /, '')")


def set_slider(page, selector, key, times):
    page.js("arguments[0].focus()", page.find(selector))
    page.press(*[key] * times)


def test_viewer(page, folder):
    article = open_viewer(page)
    truth, result = linear_of(page, article, "truth"), linear_of(page, article, "default")
    check("the viewer has the focus", page.js("return document.activeElement.id") == "viewer-canvas")
    check("the first method behind the baseline is shown first", chosen(page) == "default", chosen(page))
    same("the result is as its 16 bits say", page, srgb(developed(page, article, result)))
    page.shot(folder, "viewer")
    page.press(Keys.ARROW_LEFT)
    check("left goes to the baseline", chosen(page) == "gain_match", chosen(page))
    page.press(Keys.ARROW_LEFT)
    check("left goes to the truth", chosen(page) == "truth", chosen(page))
    same("the truth is as its 16 bits say", page, srgb(developed(page, article, truth)))
    page.press(Keys.ARROW_LEFT)
    check("left again goes to the photo", chosen(page) == "photo", chosen(page))
    photo = canvas(page)
    page.press("1")
    check("1 is the reference", chosen(page) == "reference", chosen(page))
    same("the reference has a size of its own", page, srgb(developed(page, article, linear_of(page, article, "reference"))))
    page.press(*[Keys.ARROW_RIGHT] * 4)
    check("right goes on", chosen(page) == "default", chosen(page))

    page.press("w")
    same("W shows camera RGB as recorded", page, srgb(developed(page, article, result, balanced=False)))
    check("W is announced", "as recorded" in page.text("#viewer-state"), page.text("#viewer-state"))
    page.press("w")
    set_slider(page, "#viewer-exposure", Keys.ARROW_RIGHT, 15)
    check("the slider's arrows do not change the picture", chosen(page) == "default", chosen(page))
    check("the exposure is announced", "+1.5 EV" in page.text("#viewer-state"), page.text("#viewer-state"))
    same("+1.5 EV", page, srgb(developed(page, article, result, 1.5)))
    set_slider(page, "#viewer-exposure", Keys.HOME, 1)
    same("−6 EV", page, srgb(developed(page, article, result, -6)))
    page.js("document.getElementById('viewer-canvas').focus()")
    page.press("0", "+", "w")
    same("0 and + are +0.5 EV", page, srgb(developed(page, article, result, 0.5, balanced=False)))
    page.press("w")
    set_slider(page, "#viewer-exposure", Keys.END, 1)
    same("+6 EV tells the darkest values apart", page, srgb(developed(page, article, result, 6)))
    page.press("0")

    set_slider(page, "#viewer-wipe", Keys.ARROW_RIGHT, 25)
    both, edge = srgb(developed(page, article, result)), round(0.25 * result.shape[1])
    both[:, :edge] = srgb(developed(page, article, truth))[:, :edge]
    same("the wipe has the truth at its left", page, both)
    check("the wipe is announced", "truth in the left 25 %" in page.text("#viewer-state"), page.text("#viewer-state"))
    page.shot(folder, "wipe")
    page.press("t")
    same("T ends the wipe", page, srgb(developed(page, article, result)))

    page.press("e")
    check("the error map has a legend", page.find("#viewer-map-legend").is_displayed())
    weights = np.array([0.2126, 0.7152, 0.0722])
    light = [np.maximum(developed(page, article, one) @ weights, 0) + 1 / 1024 for one in (result, truth)]
    place = np.clip(np.log2(light[0] / light[1]), -1, 1)[..., None]
    ends = np.where(place < 0, np.array([33, 102, 172]), np.array([179, 88, 6]))
    same("the error map", page, (247 + (ends - 247) * np.abs(place)) / 255)
    page.shot(folder, "error_map")
    page.press("e")
    check("the legend goes with it", not page.find("#viewer-map-legend").is_displayed())

    page.press("?")
    check("? lists the keys", page.find("#viewer-keys dl").is_displayed())
    page.shot(folder, "keys")
    page.press("?")
    page.js("document.getElementById('viewer-canvas').focus()")
    page.press(Keys.ARROW_DOWN)
    page.wait("down goes to the next image", lambda: "Image 2 of" in page.text("#viewer-state"))
    check("it has another title", page.text("#viewer-title") != "", page.text("#viewer-title"))
    check("the picture of the same kind stays", chosen(page) == "default", chosen(page))
    page.press("p", "p")
    page.wait("P goes round to the last", lambda: "Image 23 of 23" in page.text("#viewer-state"))
    page.press(Keys.ESCAPE)
    page.wait("Escape closes", lambda: not page.find("#viewer").is_displayed())
    check("the focus is back", page.js("return document.activeElement.matches('.sortable a')"))
    check("a photo is no black square", photo.mean() > 0.1, photo.mean())
    unnamed = page.js("return [...document.querySelectorAll('#viewer input, #viewer button')]"
                      ".filter(one => !(one.labels && one.labels.length) && !one.textContent.trim()).map(one => one.id)")
    check("every control has a label", unnamed == [], unnamed)


def test_structure(page, name):
    broken = page.js("""
        const bad = [];
        for (const table of document.querySelectorAll('table')) {
            if (!table.caption) bad.push('no caption');
            for (const head of table.querySelectorAll('th')) if (!head.scope) bad.push('no scope: ' + head.textContent);
        }
        for (const chart of document.querySelectorAll('figure.chart svg:not([aria-hidden])'))
            if (chart.getAttribute('role') !== 'img' || !chart.querySelector('title') || !chart.querySelector('desc'))
                bad.push('a chart has no name');
        for (const image of document.images) if (!image.alt) bad.push('a picture has no text');
        const ids = [...document.querySelectorAll('[id]')].map(one => one.id);
        if (new Set(ids).size !== ids.length) bad.push('an id twice');
        for (const link of document.querySelectorAll('a[href^="#"]'))
            if (!document.getElementById(link.hash.slice(1))) bad.push('a link leads nowhere: ' + link.hash);
        return bad;""")
    check(f"{name}: tables, charts and pictures have names", broken == [], broken[:5])
    text = page.js("return ['body > header', 'main', 'body > footer']"
                   ".map(part => document.querySelector(part).textContent).join(' ')")
    check(f"{name}: hostile names are text", HOSTILE in text and "</table>" in text and "onerror=alert(3)" in text)
    check(f"{name}: they are no elements", page.js("return document.querySelectorAll('[onerror], td script, main b')"
                                                  ".length") == 0)
    check(f"{name}: bytes that are no UTF-8 are shown as such", "caf\\xe9/\\xff\\xfe\\x07.dng" in text)
    check(f"{name}: nothing is undefined", "NaN" not in text and "nan" not in text.split())
    wide = page.js("return document.documentElement.scrollWidth - document.documentElement.clientWidth")
    check(f"{name}: the page is no wider than its window", wide <= 0, f"{wide} pixels")


def colors(page):
    return page.js("const style = getComputedStyle(document.body); return [style.color, style.backgroundColor]"
                   ".map(text => text.match(/[0-9]+/g).slice(0, 3).reduce((sum, one) => sum + Number(one), 0) / 765)")


def test_unpaired(page, folder):
    test_structure(page, "unpaired")
    open_viewer(page)
    page.press("e")
    check("without truth there is no error map", not page.find("#viewer-map").is_displayed())
    page.press("t")
    check("without truth the wipe is against the photo", "photo in the left 50 %" in page.text("#viewer-state"),
          page.text("#viewer-state"))
    check("a result is shown", chosen(page) == "default", chosen(page))
    page.shot(folder, "unpaired_viewer")
    page.press(Keys.ESCAPE)


def test_without_scripts(path, folder):
    page = Page(path, scripts=False)
    check("no script ran", page.all(".scripted, .open") == [])
    check("tables are there", page.find("#summary table").is_displayed() and page.find(".sortable td").is_displayed())
    check("charts are there", page.find("figure.chart svg").is_displayed())
    check("the viewer is not", not page.find("#viewer").is_displayed())
    for kind in ("truth", "photo"):
        element = page.find(f"figure[data-kind={kind}] .crop")
        pixels = page.shown(element)
        check(f"the {kind} is visible", pixels.mean() > 0.1 and pixels.std() > 0.05, (pixels.mean(), pixels.std()))
    source = page.find("figure[data-kind=truth] img").get_attribute("src")
    data = page.find("article.image")
    balance, color = (np.array([float(word) for word in data.get_attribute("data-" + name).split()])
                      for name in ("balance", "color"))
    linear = linear_file(source)
    expected, pixels = srgb((linear * balance) @ color.reshape(3, 3).T), page.shown(page.find(
        "figure[data-kind=truth] .crop"))
    place = [(0.9, 0.1), (0.9, 0.9), (0.3, 0.4)]  # x, y of flat places
    for x, y in place:
        wanted = expected[int(y * expected.shape[0]), int(x * expected.shape[1])]
        got = pixels[int(y * pixels.shape[0]), int(x * pixels.shape[1])]
        check(f"the filter develops the truth at {x}, {y}", np.abs(wanted - got).max() < 0.06, f"{got}, expected {wanted}")
    page.size(1280, 2400)
    page.shot(folder, "without_scripts")
    page.end("without scripts")


def main():
    make_report = Path(sys.argv[1]).resolve()
    folder = Path(sys.argv[2]).resolve() if len(sys.argv) > 2 else None
    if folder:
        folder.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory() as scratch:
        paired, unpaired = Path(scratch) / "a paired #1.html", Path(scratch) / "unpaired.html"
        subprocess.run([make_report, paired, "paired", "60", "24"], check=True)
        subprocess.run([make_report, unpaired, "unpaired", "20", "8"], check=True)

        page = Page(paired)
        page.shot(folder, "light")
        test_structure(page, "paired")
        test_sorting(page)
        test_viewer(page, folder)
        light = colors(page)
        page.scheme("dark")
        dark = colors(page)
        check("light is dark on light", light[0] < 0.2 < 0.9 < light[1], light)
        check("dark is light on dark", dark[1] < 0.2 < 0.8 < dark[0], dark)
        page.js("scrollTo({top: 0, behavior: 'instant'})")
        page.shot(folder, "dark")
        page.js("document.getElementById('charts').scrollIntoView({behavior: 'instant'})")
        page.shot(folder, "dark_charts")
        open_viewer(page)
        page.shot(folder, "dark_viewer")
        page.press(Keys.ESCAPE)
        pdf = base64.b64decode(page.cdp("Page.printToPDF", printBackground=False, preferCSSPageSize=True)["data"])
        check("it prints", pdf[:5] == b"%PDF-" and pdf.count(b"/Type /Page\n") + pdf.count(b"/Type /Page ") > 3, len(pdf))
        if folder:
            (folder / "print.pdf").write_bytes(pdf)
        page.end("paired")

        page = Page(paired, width=390, height=844)
        test_structure(page, "phone")
        page.shot(folder, "phone")
        for part in ("charts", "images"):
            page.js("document.getElementById(arguments[0]).scrollIntoView({behavior: 'instant'})", part)
            page.shot(folder, "phone_" + part)
        page.js("document.querySelector('article.image').scrollIntoView({behavior: 'instant'})")
        page.shot(folder, "phone_pictures")
        open_viewer(page)
        page.shot(folder, "phone_viewer")
        page.end("phone")

        page = Page(unpaired)
        page.shot(folder, "unpaired")
        test_unpaired(page, folder)
        page.end("unpaired")
        test_without_scripts(paired, folder)
    return finish()


sys.exit(main())
