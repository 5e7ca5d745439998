# SPDX-License-Identifier: Apache-2.0
"""Headless Chromium, controlled over its debugging protocol: makes the PDF and checks the page."""

from __future__ import annotations

import base64
import itertools
import json
import os
import shutil
import subprocess
import tempfile
import time
import urllib.request
from pathlib import Path
from types import TracebackType
from typing import Any

import websocket

from .errors import Unavailable

START_SECONDS = 60
NAMES = ("chromium", "chromium-browser", "google-chrome")
# WebGL 2 without a GPU: SwiftShader renders on the processor.
OPTIONS = [
    "--headless=new",
    "--disable-gpu-sandbox",
    "--use-angle=swiftshader",
    "--enable-unsafe-swiftshader",
    "--no-first-run",
    "--disable-extensions",
    "--hide-scrollbars",
    "--remote-debugging-port=0",
    "--force-color-profile=srgb",
]


class Browser:
    """A running browser with one page. `events`: all events that the browser sent, in order."""

    def __init__(self, *options: str):
        program = next((found for name in NAMES if (found := shutil.which(name))), None)
        if program is None:
            raise Unavailable("chromium is missing: tools/setup report installs it; --no-pdf makes only the page")
        self.folder = tempfile.mkdtemp(prefix="mandelreport-")
        # Chromium's sandbox does not work as root.
        root = ["--no-sandbox"] if os.geteuid() == 0 else []
        self.process = subprocess.Popen(
            [program, *OPTIONS, *root, *options, f"--user-data-dir={self.folder}", "about:blank"],
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
        )
        self.events: list[dict[str, Any]] = []
        self.numbers = itertools.count(1)
        try:
            self.socket = websocket.create_connection(self._address(), timeout=300, suppress_origin=True)
        except BaseException:
            self._end()
            raise

    def _address(self) -> str:
        """Waits until the page can be controlled, and returns the address of its WebSocket."""
        port_file = Path(self.folder) / "DevToolsActivePort"
        end = time.monotonic() + START_SECONDS
        while time.monotonic() < end:
            if self.process.poll() is not None:
                raise Unavailable(f"chromium ended with exit code {self.process.returncode}")
            if port_file.exists() and (lines := port_file.read_text(encoding="ascii").splitlines()):
                with urllib.request.urlopen(f"http://127.0.0.1:{lines[0]}/json/list") as answer:
                    pages = [page for page in json.load(answer) if page["type"] == "page"]
                if pages:
                    return pages[0]["webSocketDebuggerUrl"]
            time.sleep(0.1)
        raise Unavailable(f"chromium did not answer within {START_SECONDS} s")

    def __enter__(self) -> Browser:
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None) -> None:
        self.socket.close()
        self._end()

    def _end(self) -> None:
        self.process.terminate()
        try:
            self.process.wait(10)
        except subprocess.TimeoutExpired:
            self.process.kill()
            self.process.wait()
        shutil.rmtree(self.folder, ignore_errors=True)

    def call(self, method: str, **parameters: Any) -> dict[str, Any]:
        """Sends one command of the protocol and returns its answer."""
        number = next(self.numbers)
        self.socket.send(json.dumps({"id": number, "method": method, "params": parameters}))
        while True:
            message = json.loads(self.socket.recv())
            if message.get("id") == number:
                if "error" in message:
                    raise Unavailable(f"chromium: {method}: {message['error']['message']}")
                return message["result"]
            self.events.append(message)

    def open(self, page: Path, fragment: str = "") -> None:
        """Opens a file and waits until it has loaded. `fragment`: the part of the address that begins with #."""
        for domain in ("Page", "Runtime", "Log", "Network"):
            self.call(f"{domain}.enable")
        self.call("Page.navigate", url=page.absolute().as_uri() + fragment)
        self.wait("document.readyState === 'complete'", 120)

    def run(self, expression: str) -> Any:
        """Returns the value of a JavaScript expression. If it is a promise, waits for the promise's value."""
        answer = self.call("Runtime.evaluate", expression=expression, returnByValue=True, awaitPromise=True)
        if "exceptionDetails" in answer:
            details = answer["exceptionDetails"]
            raise Unavailable(f"chromium: {details.get('exception', {}).get('description', details['text'])}")
        return answer["result"].get("value")

    def wait(self, expression: str, seconds: float) -> bool:
        """Waits until the expression is true, at most for `seconds`. Returns false on timeout."""
        end = time.monotonic() + seconds
        while not self.run(expression):
            if time.monotonic() > end:
                return False
            time.sleep(0.1)
        return True

    def size(self, width: int, height: int) -> None:
        self.call("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=1, mobile=False)

    def screenshot(self) -> bytes:
        """Returns a PNG of the visible part of the page."""
        return base64.b64decode(self.call("Page.captureScreenshot", format="png")["data"])

    def pdf(self) -> bytes:
        """Returns the page as PDF, with its print style sheet."""
        answer = self.call(
            "Page.printToPDF",
            printBackground=True,
            preferCSSPageSize=True,
            generateDocumentOutline=True,
            generateTaggedPDF=True,
        )
        return base64.b64decode(answer["data"])

    def problems(self) -> list[str]:
        """Returns errors of scripts, errors on the console, and requests for anything but files and data URIs."""
        found = []
        for event in self.events:
            what, about = event.get("method"), event.get("params", {})
            if what == "Runtime.exceptionThrown":
                details = about["exceptionDetails"]
                found.append(details.get("exception", {}).get("description", details["text"]))
            elif what == "Runtime.consoleAPICalled" and about["type"] in ("error", "warning", "assert"):
                found.append("console: " + " ".join(str(a.get("value", a.get("description", ""))) for a in about["args"]))
            elif what == "Log.entryAdded" and about["entry"]["level"] in ("error", "warning"):
                found.append(f"log: {about['entry']['text']}")
            elif what == "Network.requestWillBeSent" and not about["request"]["url"].startswith(
                ("file:", "data:", "blob:")
            ):
                found.append(f"network: {about['request']['url']}")
        return found


def print_page(page: Path) -> bytes:
    """Returns the page as PDF."""
    with Browser() as browser:
        browser.open(page)
        # Decodes all pictures first, including those that are not visible.
        browser.run("Promise.all([...document.images].map((image) => image.decode().catch(() => 0))).then(() => 1)")
        return browser.pdf()
