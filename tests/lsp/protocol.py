"""Holds every message of a session against the types of the protocol: the messages become literals of a TypeScript program with the types
of the npm package vscode-languageserver-protocol, and its compiler says what does not fit (a member too many, too few, of another type)."""
import json
import os
import subprocess

PACKAGES = ["vscode-languageserver-protocol@3.17.5", "typescript@5.4.5"]
RESULTS = {
    "initialize": "InitializeResult", "shutdown": "null", "workspace/executeCommand": "unknown",
    "textDocument/hover": "Hover | null", "textDocument/inlayHint": "InlayHint[] | null", "textDocument/completion": "CompletionList | null",
    "textDocument/documentSymbol": "DocumentSymbol[] | SymbolInformation[] | null", "textDocument/foldingRange": "FoldingRange[] | null",
    "textDocument/definition": "Location | null", "textDocument/references": "Location[] | null",
    "textDocument/documentHighlight": "DocumentHighlight[] | null",
    "textDocument/codeAction": "CodeAction[] | null", "textDocument/codeLens": "CodeLens[] | null",
    "deck/card": "unknown", "deck/gapReport": "{ html: string } | { file: string }", "deck/explain": "{ text: string }"}
SAID = {
    "textDocument/publishDiagnostics": "PublishDiagnosticsParams", "window/logMessage": "LogMessageParams",
    "$/progress": "{ token: ProgressToken; value: WorkDoneProgressBegin | WorkDoneProgressReport | WorkDoneProgressEnd }",
    "window/workDoneProgress/create": "WorkDoneProgressCreateParams", "workspace/applyEdit": "ApplyWorkspaceEditParams",
    "window/showDocument": "ShowDocumentParams", "workspace/codeLens/refresh": None, "workspace/inlayHint/refresh": None}


def install(folder):
    """The folder with compiler and types, or why there is none."""
    os.makedirs(folder, exist_ok=True)
    if os.path.exists(os.path.join(folder, "node_modules", "typescript", "bin", "tsc")):
        return None
    try:
        r = subprocess.run(["npm", "install", "--prefix", folder, "--no-save", "--ignore-scripts", "--no-audit", "--no-fund", *PACKAGES],
                           capture_output=True, text=True, timeout=180)
    except (OSError, subprocess.TimeoutExpired) as e:
        return "npm: %s" % e
    return None if r.returncode == 0 else "npm: " + r.stderr.strip().split("\n")[-1][:200]


def unlike(messages):
    """One of each shape: names and types of members count, texts and numbers do not."""
    def shape(v):
        if isinstance(v, dict):
            return tuple((k, shape(x)) for k, x in sorted(v.items()))
        if isinstance(v, list):
            return ("list", tuple(sorted({repr(shape(x)) for x in v})))
        return type(v).__name__
    seen = {}
    for kind, value in messages:
        seen.setdefault((kind, repr(shape(value))), value)
    return [(kind, value) for (kind, _), value in seen.items()]


def short(v):
    """Long lists say nothing new behind their first hundred."""
    if isinstance(v, dict):
        return {k: short(x) for k, x in v.items()}
    if isinstance(v, list):
        return [short(x) for x in v[:100]]
    return v


def collect(client):
    """([(type, value)], [what is none of the protocol]) of everything the server said."""
    values, wrong = [], []
    for m in client.log:
        if m.get("jsonrpc") != "2.0":
            wrong.append("no jsonrpc: %s" % str(m)[:100])
        if "method" in m:
            if m["method"] not in SAID:
                wrong.append("the server said " + m["method"])
            elif SAID[m["method"]] is None:
                if m.get("params") is not None:
                    wrong.append("%s with parameters" % m["method"])
            else:
                values.append((SAID[m["method"]], m["params"]))
        elif "error" in m:
            values.append(("{ code: number; message: string; data?: unknown }", m["error"]))
        elif client.sent.get(m["id"]) not in RESULTS:
            wrong.append("an answer to %s" % client.sent.get(m["id"]))
        else:
            values.append((RESULTS[client.sent[m["id"]]], m["result"]))
    return values, wrong


def check(folder, values):
    """[what does not fit], number of messages that were looked at."""
    chosen = unlike((k, short(v)) for k, v in values)
    path = os.path.join(folder, "messages.ts")
    with open(path, "w", encoding="utf-8") as f:
        f.write('import * as P from "vscode-languageserver-protocol";\n')
        for name in ("InitializeResult Hover InlayHint CompletionList DocumentSymbol SymbolInformation FoldingRange Location "
                     "DocumentHighlight Range WorkspaceEdit "
                     "CodeAction CodeLens TextEdit PublishDiagnosticsParams LogMessageParams ProgressToken WorkDoneProgressBegin "
                     "WorkDoneProgressReport WorkDoneProgressEnd WorkDoneProgressCreateParams ApplyWorkspaceEditParams ShowDocumentParams").split():
            f.write("type %s = P.%s;\n" % (name, name))
        for n, (kind, value) in enumerate(chosen):
            f.write("export const m%d: %s = %s;\n" % (n, kind, json.dumps(value)))
    r = subprocess.run([os.path.join(folder, "node_modules", "typescript", "bin", "tsc"), "--noEmit", "--strict", "--skipLibCheck",
                        "--target", "es2020", "--module", "commonjs", "--moduleResolution", "node", path],
                       cwd=folder, capture_output=True, text=True, timeout=600)
    return [line for line in r.stdout.split("\n") if ": error " in line], len(chosen)
