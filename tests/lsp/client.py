"""A language client for tests: talks to `deck lsp`, keeps the texts of open documents, and notes everything that was said."""
import json
import os
import queue
import subprocess
import threading
import time
from urllib.parse import quote, unquote

CAPABILITIES = {
    "general": {"positionEncodings": ["utf-16"]},
    "window": {"workDoneProgress": True, "showDocument": {"support": True}},
    "workspace": {"workspaceEdit": {"documentChanges": True}, "codeLens": {"refreshSupport": True},
                  "inlayHint": {"refreshSupport": True}, "applyEdit": True},
    "textDocument": {"hover": {"contentFormat": ["markdown", "plaintext"]},
                     "completion": {"completionItem": {"snippetSupport": True}},
                     "documentSymbol": {"hierarchicalDocumentSymbolSupport": True},
                     "publishDiagnostics": {"versionSupport": True, "relatedInformation": True}}}


def uri_of(path):
    return "file://" + quote(path, safe="/-._~")


def path_of(uri):
    return unquote(uri[len("file://"):])


class Gone(Exception):
    """The server has ended."""


class Failed(Exception):
    """A request was answered with an error."""

    def __init__(self, error):
        super().__init__("%(code)s %(message)s" % error)
        self.code, self.message = error["code"], error["message"]


def units(text, encoding="utf-16"):
    return len(text.encode("utf-16-le")) // 2 if encoding == "utf-16" else len(text.encode("utf-8"))


class Client:
    def __init__(self, deck, options=None, capabilities=None, folder=None, arguments=(), env=None):
        self.process = subprocess.Popen([deck, "lsp", *arguments], stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                                        stderr=subprocess.PIPE, env=env)
        self.inbox = queue.Queue()
        self.answers, self.notes, self.asked, self.log = {}, [], [], []
        self.errors = b""
        self.next = 1
        self.texts, self.versions, self.diagnostics = {}, {}, {}
        self.sent = {}
        for target in (self._read, self._read_errors):
            threading.Thread(target=target, daemon=True).start()
        if options is not None:
            self.server = self.request("initialize", {
                "processId": os.getpid(), "rootUri": uri_of(folder) if folder else None,
                "capabilities": capabilities or CAPABILITIES, "initializationOptions": options})
            self.encoding = self.server["capabilities"]["positionEncoding"]
            self.notify("initialized", {})

    # ---- frames
    def _read(self):
        out = self.process.stdout
        while True:
            length = None
            while True:
                line = out.readline()
                if not line:
                    self.inbox.put(None)
                    return
                line = line.strip()
                if not line:
                    break
                name, value = line.split(b":", 1)
                if name.lower() == b"content-length":
                    length = int(value)
            self.inbox.put(json.loads(out.read(length)))

    def _read_errors(self):
        self.errors = self.process.stderr.read()

    def send_raw(self, body):
        try:
            self.process.stdin.write(b"Content-Length: %d\r\n\r\n" % len(body) + body)
            self.process.stdin.flush()
        except BrokenPipeError as e:
            raise Gone() from e

    def send(self, message):
        message["jsonrpc"] = "2.0"
        self.send_raw(json.dumps(message).encode())

    def take(self, timeout=60):
        """The next message of the server, sorted to where it belongs."""
        m = self.inbox.get(timeout=timeout)
        if m is None:
            self.inbox.put(None)
            raise Gone()
        self.log.append(m)
        if "method" in m and "id" in m:
            self.asked.append(m)
            answer = {"applied": True} if m["method"] == "workspace/applyEdit" else {"success": True} \
                if m["method"] == "window/showDocument" else None
            self.send({"id": m["id"], "result": answer})
        elif "method" in m:
            self.notes.append(m)
            if m["method"] == "textDocument/publishDiagnostics":
                self.diagnostics[path_of(m["params"]["uri"])] = m["params"]
        else:
            self.answers[m["id"]] = m
        return m

    def until(self, done, timeout=60):
        end = time.monotonic() + timeout
        while not done():
            left = end - time.monotonic()
            if left <= 0:
                raise TimeoutError("the server did not do what was waited for")
            try:
                self.take(left)
            except queue.Empty as e:
                raise TimeoutError("the server is silent") from e

    def start(self, method, params=None):
        self.next += 1
        message = {"id": self.next, "method": method}
        if params is not None:
            message["params"] = params
        self.sent[self.next] = method
        self.send(message)
        return self.next

    def answer(self, number, timeout=60):
        self.until(lambda: number in self.answers, timeout)
        m = self.answers[number]
        if "error" in m:
            raise Failed(m["error"])
        return m["result"]

    def request(self, method, params=None, timeout=60):
        return self.answer(self.start(method, params), timeout)

    def notify(self, method, params):
        self.send({"method": method, "params": params})

    def end(self):
        self.request("shutdown")
        self.notify("exit", None)
        return self.process.wait(timeout=60)

    def kill(self):
        self.process.kill()
        self.process.wait()

    # ---- documents
    def open(self, path, text=None):
        if text is None:
            with open(path, encoding="utf-8", errors="surrogateescape", newline="") as f:
                text = f.read().encode("utf-8", "surrogateescape").decode("utf-8", "replace")
        self.texts[path], self.versions[path] = text, 1
        self.notify("textDocument/didOpen", {"textDocument": {"uri": uri_of(path), "languageId": "radioss", "version": 1, "text": text}})
        return text

    def place(self, path, offset):
        """LSP position of an offset (in characters) of the text."""
        before = self.texts[path][:offset]
        line = before.count("\n")
        return {"line": line, "character": units(before[before.rfind("\n") + 1:], self.encoding)}

    def offset(self, path, place):
        text = self.texts[path]
        at = 0
        for _ in range(place["line"]):
            at = text.index("\n", at) + 1
        left = place["character"]
        while left > 0:
            left -= units(text[at], self.encoding)
            at += 1
        return at

    def change(self, path, begin, end, by):
        """Replaces characters [begin, end) of the text."""
        params = {"range": {"start": self.place(path, begin), "end": self.place(path, end)}, "text": by}
        text = self.texts[path]
        self.texts[path] = text[:begin] + by + text[end:]
        self.versions[path] += 1
        self.notify("textDocument/didChange", {"textDocument": {"uri": uri_of(path), "version": self.versions[path]}, "contentChanges": [params]})

    def save(self, path):
        self.notify("textDocument/didSave", {"textDocument": {"uri": uri_of(path)}})

    def close(self, path):
        self.notify("textDocument/didClose", {"textDocument": {"uri": uri_of(path)}})

    def settled(self, path, timeout=120):
        """Findings of the text as it is now."""
        self.until(lambda: self.diagnostics.get(path, {}).get("version") == self.versions[path], timeout)
        return self.diagnostics[path]["diagnostics"]

    def at(self, path, line, character, **more):
        return {"textDocument": {"uri": uri_of(path)}, "position": {"line": line, "character": character}, **more}

    def of(self, path, **more):
        return {"textDocument": {"uri": uri_of(path)}, **more}

    def edited(self, edit):
        """The texts after a WorkspaceEdit, by path; nothing is sent."""
        changes = {c["textDocument"]["uri"]: c["edits"] for c in edit["documentChanges"]} if "documentChanges" in edit else edit["changes"]
        out = {}
        for uri, edits in changes.items():
            path = path_of(uri)
            if path not in self.texts:
                with open(path, encoding="utf-8", newline="") as f:
                    self.texts[path] = f.read()
            text = self.texts[path]
            spans = sorted(((self.offset(path, e["range"]["start"]), self.offset(path, e["range"]["end"]), e["newText"]) for e in edits), reverse=True)
            for (begin, end, by), before in zip(spans, [None] + spans):
                if before is not None and end > before[0]:
                    raise ValueError("edits overlap")
                text = text[:begin] + by + text[end:]
            out[path] = text
        return out

    def seconds(self):
        """Processor time of the server so far, user and system, in all threads."""
        total = 0
        folder = "/proc/%d/task" % self.process.pid
        for task in os.listdir(folder):
            with open("%s/%s/schedstat" % (folder, task)) as f:
                total += int(f.read().split()[0])
        return total / 1e9

    def memory(self):
        """Resident bytes now and at most."""
        with open("/proc/%d/status" % self.process.pid) as f:
            lines = dict(line.split(":", 1) for line in f)
        return int(lines["VmRSS"].split()[0]) * 1024, int(lines["VmHWM"].split()[0]) * 1024
