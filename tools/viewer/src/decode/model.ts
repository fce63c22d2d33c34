// The model of a page from its blocks: mesh with what is drawn of it, and contacts. The same beside the page, in a thread,
// and in the page where it can have none.
import { inflateText, readContacts, readMesh, type Contacts, type Mesh } from "../data";
import type { Meta } from "schema/page";
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
}

/** `coarse`: whether the machine draws slowly, asked for late; `say`: share of the work that is done, 0 to 1, and what comes next. */
export async function decode(blocks: Blocks, coarse: () => boolean | Promise<boolean>, say: (done: number, next: string) => void): Promise<Model> {
  const meta = JSON.parse(blocks.meta) as Meta;
  const mesh = readMesh(await inflateText(blocks.mesh));
  say(0.3, "Reading the contacts …");
  const contacts = readContacts(await inflateText(blocks.shared), await inflateText(blocks.contacts), meta, mesh.nodeId.length);
  say(0.6, "Preparing the picture …");
  const shapes = shapesOf(mesh, await coarse());
  say(1, "Building the tables …");
  return { mesh, shapes, contacts };
}
