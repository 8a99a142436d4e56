#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""A picture of a report's viewer: what the model `default` made at the right of a wipe, the truth at its left.

    /usr/bin/python3 tests/bench/report_picture.py REPORT.html PICTURE.jpg [IMAGE]

IMAGE: which of the images shown, from 1. Needs Chromium and Selenium (Debian: chromium-driver, python3-selenium)."""
import base64
import os
import pathlib
import sys
import tempfile

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "../tools/srispeval/report"))
from browser_page import Page  # noqa: E402

import OpenImageIO as oiio  # noqa: E402
from selenium.webdriver.common.keys import Keys  # noqa: E402


def main():
    report, picture = sys.argv[1:3]
    page = Page(pathlib.Path(report).resolve(), 1200, 640)
    page.js("document.querySelector('article button').click()")
    page.wait("the viewer opens", lambda: "Image 1 of" in page.text("#viewer-state"))
    page.js("document.getElementById('viewer-canvas').focus()")
    for number in range(2, int(sys.argv[3]) + 1 if len(sys.argv) > 3 else 1):
        page.press(Keys.ARROW_DOWN)
        page.wait("the next image", lambda: f"Image {number} of" in page.text("#viewer-state"))
    page.js("[...document.querySelectorAll('#viewer-choice input')]"
            ".find(one => one.parentElement.textContent.includes('default')).click()")
    page.js("const wipe = document.getElementById('viewer-wipe'); wipe.value = 50;"
            "wipe.dispatchEvent(new Event('input', { bubbles: true }))")
    page.wait("the wipe", lambda: "50 %" in page.text("#viewer-state"))
    with tempfile.NamedTemporaryFile(suffix=".png") as file:
        file.write(base64.b64decode(page.cdp("Page.captureScreenshot")["data"]))
        file.flush()
        image = oiio.ImageBuf(file.name)
        image.specmod().attribute("Compression", "jpeg:88")
        oiio.ImageBufAlgo.channels(image, (0, 1, 2)).write(picture)
    page.driver.quit()


if __name__ == "__main__":
    main()
