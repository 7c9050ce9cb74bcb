"""chromium.py - a headless Chromium that is driven through a pipe by the DevTools protocol.

Keys, pointer and pages are real: what a test presses goes through the browser's own input.
"""
import json
import os
import subprocess


class Chromium:
    """A browser with one page."""

    def __init__(self, program, profile):
        to_browser, self._out = os.pipe()
        self._in, from_browser = os.pipe()

        def place_pipes():
            # The browser reads commands from descriptor 3 and writes replies to descriptor 4.
            ends = os.dup(to_browser), os.dup(from_browser)
            os.dup2(ends[0], 3)
            os.dup2(ends[1], 4)

        self._process = subprocess.Popen(
            [program, "--headless", "--no-sandbox", "--disable-gpu", "--disable-background-networking",
             "--remote-debugging-pipe", f"--user-data-dir={profile}", "about:blank"],
            preexec_fn=place_pipes, close_fds=False,
            stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        os.close(to_browser)
        os.close(from_browser)
        self._buffer = b""
        self._number = 0
        self._session = None
        self.events = []
        self.exceptions = []  # of all pages so far
        page = next(t for t in self.call("Target.getTargets")["targetInfos"] if t["type"] == "page")
        self._session = self.call("Target.attachToTarget", targetId=page["targetId"],
                                  flatten=True)["sessionId"]
        self.call("Page.enable")
        self.call("Runtime.enable")

    def close(self):
        """Ends the browser."""
        os.close(self._out)
        os.close(self._in)
        self._process.terminate()
        self._process.wait()

    def _read(self):
        while b"\0" not in self._buffer:
            piece = os.read(self._in, 1 << 20)
            if not piece:
                raise EOFError("the browser has ended")
            self._buffer += piece
        message, self._buffer = self._buffer.split(b"\0", 1)
        found = json.loads(message)
        if found.get("method") == "Runtime.exceptionThrown":
            details = found["params"]["exceptionDetails"]  # of a script from elsewhere the text alone
            self.exceptions.append(details.get("exception", {}).get("description", details["text"]))
        return found

    def call(self, method, **params):
        """Calls a method of the protocol and returns its result; events meanwhile are kept."""
        self._number += 1
        message = {"id": self._number, "method": method, "params": params}
        if self._session:
            message["sessionId"] = self._session
        os.write(self._out, json.dumps(message).encode() + b"\0")
        while True:
            reply = self._read()
            if reply.get("id") == self._number:
                if "error" in reply:
                    raise RuntimeError(f"{method}: {reply['error']['message']}")
                return reply["result"]
            self.events.append(reply)

    def wait(self, name):
        """Waits for an event."""
        while True:
            for i, event in enumerate(self.events):
                if event.get("method") == name:
                    return self.events.pop(i)["params"]
            self.events.append(self._read())

    def open(self, address, width, dark=False, script=True, still=False):
        """Opens a page of some width in CSS pixels, light or dark, with or without its script, for a
        reader who prefers reduced motion or does not."""
        self.call("Emulation.setDeviceMetricsOverride", width=width, height=900,
                  deviceScaleFactor=1, mobile=False)
        self.call("Emulation.setEmulatedMedia", features=[
            {"name": "prefers-color-scheme", "value": "dark" if dark else "light"},
            {"name": "prefers-reduced-motion", "value": "reduce" if still else "no-preference"}])
        self.call("Emulation.setScriptExecutionDisabled", value=not script)
        self.events.clear()
        self.call("Page.navigate", url=address)
        self.wait("Page.loadEventFired")

    def run(self, expression):
        """The value of an expression in the page, of a promise when it is there."""
        result = self.call("Runtime.evaluate", expression=expression, awaitPromise=True,
                           returnByValue=True)
        if "exceptionDetails" in result:
            raise RuntimeError(result["exceptionDetails"]["exception"]["description"])
        return result["result"].get("value")

    def press(self, key, text=""):
        """Presses a key where the focus is."""
        codes = {"+": 187, "-": 189, "0": 48, "Enter": 13, "Escape": 27, " ": 32, "Tab": 9, "End": 35, "Home": 36,
                 "ArrowLeft": 37, "ArrowUp": 38, "ArrowRight": 39, "ArrowDown": 40}
        text = {"Enter": "\r", " ": " "}.get(key, text)
        for kind in "keyDown", "keyUp":
            self.call("Input.dispatchKeyEvent", type=kind, key=key, windowsVirtualKeyCode=codes[key],
                      **({"text": text} if text and kind == "keyDown" else {}))

    def _place(self, element, part=0.5):
        return self.run(f"(() => {{ const e = {element}; e.scrollIntoView({{block: 'center'}});"
                        "const b = e.getBoundingClientRect();"
                        f"return [b.left + b.width * {part}, b.top + b.height / 2]; }})()")

    def _mouse(self, kind, x, y, **more):
        self.call("Input.dispatchMouseEvent", type=kind, x=x, y=y, **more)

    def click(self, element):
        """Clicks the middle of an element, given as an expression."""
        x, y = self._place(element)
        for kind in "mouseMoved", "mousePressed", "mouseReleased":
            self._mouse(kind, x, y, button="left", clickCount=1)

    def point(self, element, part=0.5):
        """Moves the pointer to a part of the width of an element, half way down."""
        self._mouse("mouseMoved", *self._place(element, part))

    def drag(self, element, begin, end):
        """Drags from a part of the width of an element to another one."""
        (x0, y), (x1, _) = self._place(element, begin), self._place(element, end)
        self._mouse("mouseMoved", x0, y)
        self._mouse("mousePressed", x0, y, button="left", clickCount=1)
        for step in range(1, 6):
            self._mouse("mouseMoved", x0 + (x1 - x0) * step / 5, y, button="left", buttons=1)
        self._mouse("mouseReleased", x1, y, button="left", clickCount=1)
