# SPDX-License-Identifier: Apache-2.0
"""A page in headless Chromium, its pixels, and what they should be by another decoder than the browser's.

Leaves the test as skipped, with a line that says why, where something is missing.
"""
import base64
import json
import shutil
import sys
import tempfile
import time


def skip(what):
    print(f"SKIPPED report_browser_test.py: needs {what}", flush=True)
    sys.exit(0)


CHROMIUM, DRIVER = shutil.which("chromium"), shutil.which("chromedriver")
if not CHROMIUM or not DRIVER:
    skip("chromium and chromedriver (Debian: chromium, chromium-driver)")
try:
    from selenium import webdriver
    from selenium.webdriver.chrome.options import Options
    from selenium.webdriver.chrome.service import Service
    from selenium.webdriver.common.by import By
except ImportError:
    skip("Selenium (Debian: python3-selenium)")
try:
    import numpy as np
    import OpenImageIO as oiio
except ImportError:
    skip("numpy and OpenImageIO for Python")

failures = checks = 0


def check(what, good, detail=""):
    global failures, checks
    checks += 1
    if not good:
        failures += 1
        print(f"FAILED {what}: {detail}", flush=True)


def finish():
    """Prints the count; the exit code."""
    print(f"{checks - failures} passed, {failures} failed", flush=True)
    return 1 if failures else 0


def start(scripts=True):
    options = Options()
    options.binary_location = CHROMIUM
    for word in ("--headless=new", "--no-sandbox", "--disable-dev-shm-usage", "--hide-scrollbars"):
        options.add_argument(word)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL", "performance": "ALL"})
    if not scripts:
        options.add_experimental_option("prefs", {"profile.managed_default_content_settings.javascript": 2})
    return webdriver.Chrome(service=Service(DRIVER), options=options)


class Page:
    """A report in a window of its own."""

    def __init__(self, path, width=1280, height=900, scheme="light", scripts=True):
        self.driver = start(scripts)
        self.size(width, height)
        self.scheme(scheme)
        self.driver.get(path.as_uri())

    def size(self, width, height):
        self.cdp("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=1, mobile=False)

    def scheme(self, name):
        self.cdp("Emulation.setEmulatedMedia", features=[{"name": "prefers-color-scheme", "value": name}])

    def cdp(self, command, **arguments):
        return self.driver.execute_cdp_cmd(command, arguments)

    def js(self, text, *arguments):
        return self.driver.execute_script(text, *arguments)

    def find(self, selector):
        return self.driver.find_element(By.CSS_SELECTOR, selector)

    def all(self, selector):
        return self.driver.find_elements(By.CSS_SELECTOR, selector)

    def press(self, *keys):
        for key in keys:
            webdriver.ActionChains(self.driver).send_keys(key).perform()

    def text(self, selector):
        return self.find(selector).get_attribute("textContent")

    def wait(self, what, condition, seconds=20):
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            if condition():
                return True
            time.sleep(0.05)
        check(what, False, "it did not happen")
        return False

    def shot(self, folder, name):
        if folder:
            time.sleep(0.2)
            data = self.cdp("Page.captureScreenshot")["data"]
            (folder / f"{name}.png").write_bytes(base64.b64decode(data))

    def shown(self, element):
        """A part of the page as it is on the screen: RGB, 0 to 1."""
        return picture_of(base64.b64decode(element.screenshot_as_base64), "png")

    def requests(self):
        messages = [json.loads(entry["message"])["message"] for entry in self.driver.get_log("performance")]
        return [message["params"]["request"]["url"] for message in messages
                if message["method"] == "Network.requestWillBeSent"]

    def end(self, name):
        """Nothing was complained of, and nothing asked for but the page itself."""
        log = self.driver.get_log("browser")
        check(f"{name}: the console is empty", log == [], log[:3])
        strangers = [url for url in self.requests() if not url.startswith(("file:", "data:"))]
        check(f"{name}: nothing is requested", strangers == [], strangers[:3])
        files = {url.split("#")[0] for url in self.requests() if url.startswith("file:")}
        check(f"{name}: no other file is read", len(files) <= 1, files)
        self.driver.quit()


def picture_of(data, ending):
    with tempfile.NamedTemporaryFile(suffix="." + ending) as file:
        file.write(data)
        file.flush()
        return oiio.ImageBuf(file.name).get_pixels(oiio.FLOAT)[..., :3]


def linear_file(source):
    """The values of a linear picture, from its data: address."""
    codes = np.rint(picture_of(base64.b64decode(source.split(",", 1)[1]), "png") * 255)
    half = codes.shape[0] // 2
    return (codes[:half] * 256 + codes[half:]) / 65535


def linear_of(page, article, name):
    return linear_file(page.js("return [...document.getElementById(arguments[0]).querySelectorAll('figure')]"
                               ".find(one => one.dataset.name === arguments[1]).querySelector('img').src", article, name))


PIXEL = 1 / 255 + 1e-6


def srgb(linear):
    value = np.clip(linear, 0, 1)
    return np.where(value <= 0.0031308, 12.92 * value, 1.055 * value ** (1 / 2.4) - 0.055)


def developed(page, article, linear, ev=0.0, balanced=True):
    numbers = page.js("const one = document.getElementById(arguments[0]).dataset; return [one.balance, one.color]", article)
    balance, color = (np.array([float(word) for word in text.split()]) for text in numbers)
    value = linear * 2.0 ** ev
    return value * 1.0 if not balanced else (value * balance) @ color.reshape(3, 3).T


def canvas(page):
    data = page.js("return document.getElementById('viewer-canvas').toDataURL('image/png')")
    return picture_of(base64.b64decode(data.split(",", 1)[1]), "png")


def same(what, page, expected):
    shown = canvas(page)
    if shown.shape != expected.shape:
        check(what, False, f"{shown.shape} pixels, expected {expected.shape}")
        return
    error = np.abs(shown - expected).max()
    check(what, error <= PIXEL, f"off by {error * 255:.2f} of 255")
