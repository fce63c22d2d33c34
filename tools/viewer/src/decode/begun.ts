// Begins to decode the page's blocks before anything else of the page is there: imported first.
import { begin } from "./client";

export const begun = begin();
