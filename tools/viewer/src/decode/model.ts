// The model of a page from its blocks: mesh with what is drawn of it, contacts, and the rows of the deck's
// settings. The same beside the page, in a thread, and in the page where it can have none.
import { inflateText, readContacts, readMesh, type Contacts, type Mesh } from "../data";
import type { Raw } from "../core";
import { Evaluator } from "../evaluate";
import type { Meta } from "../meta";
import { shapesOf, type Shape } from "./shape";

export interface Blocks {
  meta: string;
  mesh: string;
  shared: string;
  contacts: string;
}

export interface Model {
  mesh: Mesh;
  shapes: Shape[];
  contacts: Contacts;
  base: Raw[];
}

/** `coarse`: whether the machine draws slowly, asked for late; `say`: share of the work that is done, 0 to 1, and what comes next. */
export async function decode(blocks: Blocks, coarse: () => boolean | Promise<boolean>, say: (done: number, next: string) => void): Promise<Model> {
  const meta = JSON.parse(blocks.meta) as Meta;
  const mesh = readMesh(await inflateText(blocks.mesh));
  say(0.3, "Reading the contacts …");
  const contacts = readContacts(await inflateText(blocks.shared), await inflateText(blocks.contacts), meta, mesh.nodeId.length);
  say(0.5, "Evaluating the contacts …");
  const base = new Evaluator(meta, contacts).rawBase();
  say(0.75, "Preparing the picture …");
  const shapes = shapesOf(mesh, await coarse());
  say(1, "Building the tables …");
  return { mesh, shapes, contacts, base };
}
