// Runs the program and collects what it says.
import { execFile } from "node:child_process";
import { dirname } from "node:path";
import type * as vscode from "vscode";

export interface Said {
  code: number; // 0: fine, 1: findings, 2: wrong call, 3: unreadable, -1: not run to its end
  out: string;
  error: string;
}

/** Runs `program` in the folder of `file`; never throws. */
export function run(program: string, call: string[], file: string, cancel?: vscode.CancellationToken): Promise<Said> {
  return new Promise((resolve) => {
    const child = execFile(program, call, { cwd: dirname(file), maxBuffer: 1 << 30, windowsHide: true }, (error, out, said) => {
      const code = !error ? 0 : typeof error.code === "number" ? error.code : -1;
      resolve({ code, out, error: said || (code === -1 ? String(error?.message) : "") });
    });
    cancel?.onCancellationRequested(() => child.kill());
  });
}
