// A thread of the page: build.mjs bundles its script as text.
declare module "*?text" {
  const script: string;
  export default script;
}
