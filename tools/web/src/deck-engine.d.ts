// What emscripten made of the program; the bundler knows where it is.
declare module "deck-engine" {
  const create: unknown;
  export default create;
}
