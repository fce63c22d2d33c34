// What the report's page and the editor say to each other.

/** A line of a file, counted from 1. */
export interface Place {
  file: string;
  line: number;
}

export type FromPage =
  | { type: "ready" }
  | { type: "selected"; key: string; pair: string; node: Place | null; card: Place }
  | { type: "interface"; id: number; card: Place }
  | { type: "open"; place: Place }
  | { type: "shown"; what: string | null }; // answer to "show"; null: nothing of the report stands there

export type ToPage =
  | { type: "show"; file: string; line: number; header: number } // header: line of the keyword above
  | { type: "restore"; interface: number | null; key: string | null };
