// What the report's page and the editor say to each other.

/** A line of a file, counted from 1. */
export interface Place {
  file: string;
  line: number;
}

/** What is chosen in the page: one interface, one pair. */
export interface Chosen {
  interface: number | null;
  key: string | null;
}

export type FromPage =
  | { type: "ready" }
  | { type: "selected"; key: string; pair: string; node: Place | null; card: Place }
  | { type: "interface"; id: number | null; card: Place | null } // null: no longer only one
  | { type: "open"; place: Place }
  | { type: "shown"; what: string | null; chosen: Chosen }; // answer to "show"; null: nothing of the report stands there

export type ToPage =
  | { type: "show"; file: string; line: number; header: number } // header: line of the keyword above
  | ({ type: "restore" } & Chosen);
