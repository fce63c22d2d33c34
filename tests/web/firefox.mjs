// A headless Firefox that opens one page and runs functions in it, spoken to by its own protocol
// (Marionette): Debian's browser as it is, and nothing else to install.
import { spawn } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { connect } from "node:net";
import { tmpdir } from "node:os";
import { join } from "node:path";

const pause = (ms) => new Promise((ok) => setTimeout(ok, ms));

/** The port that the browser chose; it writes it into its profile. */
async function portOf(profile, gone) {
  for (let i = 0; i < 600 && !gone(); ++i) {
    try {
      const port = Number(readFileSync(join(profile, "MarionetteActivePort"), "utf8"));
      if (port > 0) return port;
    } catch {
      // not yet
    }
    await pause(100);
  }
  throw new Error("Firefox does not listen");
}

/** Messages are "LENGTH:JSON": [0, id, command, parameters] and [1, id, error, result]. */
function talk(socket) {
  const waiting = new Map();
  let parts = [];
  let have = 0;
  let wanted = -1;
  const fail = (e) => {
    for (const { no } of waiting.values()) no(e);
    waiting.clear();
  };
  socket.on("data", (chunk) => {
    parts.push(chunk);
    have += chunk.length;
    while (have > 0) {
      if (wanted < 0) {
        const all = Buffer.concat(parts);
        const colon = all.indexOf(58);
        if (colon < 0) return;
        wanted = Number(all.subarray(0, colon));
        parts = [all.subarray(colon + 1)];
        have -= colon + 1;
      }
      if (have < wanted) return;
      const all = Buffer.concat(parts);
      const message = JSON.parse(all.subarray(0, wanted).toString());
      parts = [all.subarray(wanted)];
      have -= wanted;
      wanted = -1;
      if (message[0] !== 1) continue; // the greeting
      const { ok, no } = waiting.get(message[1]) ?? {};
      waiting.delete(message[1]);
      if (message[2]) no?.(new Error(`Firefox: ${message[2].message ?? message[2].error}`));
      else ok?.(message[3]);
    }
  });
  socket.on("error", fail);
  socket.on("close", () => fail(new Error("Firefox is gone")));
  let id = 0;
  return (command, parameters = {}) =>
    new Promise((ok, no) => {
      waiting.set(++id, { ok, no });
      const text = Buffer.from(JSON.stringify([0, id, command, parameters]));
      socket.write(Buffer.concat([Buffer.from(`${text.length}:`), text]));
    });
}

/** Opens a file; `evaluate(f, argument)` as in Chromium's driver: arguments and results are JSON. */
export async function openInFirefox(program, file) {
  const profile = mkdtempSync(join(tmpdir(), "deck-firefox-"));
  writeFileSync(join(profile, "user.js"), [
    ["marionette.port", 0], ["app.update.enabled", false], ["datareporting.policy.dataSubmissionEnabled", false],
    ["browser.shell.checkDefaultBrowser", false], ["network.captive-portal-service.enabled", false], ["network.connectivity-service.enabled", false],
  ].map(([name, value]) => `user_pref(${JSON.stringify(name)}, ${value});\n`).join(""));
  const browser = spawn(program, ["--headless", "--no-remote", "--marionette", "--profile", profile, "about:blank"], { stdio: "ignore" });
  const ended = new Promise((ok) => browser.once("exit", ok).once("error", ok));
  let socket;
  const close = async () => {
    socket?.destroy();
    browser.kill();
    await ended;
    rmSync(profile, { recursive: true, force: true, maxRetries: 5, retryDelay: 200 });
  };
  try {
    socket = connect(await portOf(profile, () => browser.exitCode !== null), "127.0.0.1");
    const ask = talk(socket);
    const { capabilities } = await ask("WebDriver:NewSession", { capabilities: { alwaysMatch: {} } });
    await ask("WebDriver:SetTimeouts", { script: 600000, pageLoad: 60000 });
    await ask("WebDriver:Navigate", { url: `file://${file}` });
    const evaluate = async (f, argument) => {
      const script = `const done = arguments[1]; Promise.resolve((${f})(arguments[0])).then((value) => done({ value }), (e) => done({ error: String(e) }));`;
      const { value } = await ask("WebDriver:ExecuteAsyncScript", { script, args: [argument ?? null], sandbox: null, newSandbox: false });
      if (value.error) throw new Error(value.error);
      return value.value;
    };
    for (let i = 0; i < 300 && !(await evaluate(() => document.documentElement.dataset.ready === "true")); ++i) await pause(100);
    return { evaluate, close, version: capabilities.browserVersion };
  } catch (e) {
    await close();
    throw e;
  }
}
