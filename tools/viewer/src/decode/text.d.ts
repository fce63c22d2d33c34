// A thread of the page as build.mjs bundles it: its script as a text.
declare module "*?text" {
  const script: string;
  export default script;
}
