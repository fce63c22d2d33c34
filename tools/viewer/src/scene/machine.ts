// What the machine can draw.

/** True where the browser has no graphics processor: smoothing would cost most of the time. */
export function drawsInSoftware(): boolean {
  // Most browsers refuse at once where everything would be slow; the others are asked for a name.
  const gl = document.createElement("canvas").getContext("webgl2", { failIfMajorPerformanceCaveat: true });
  if (!gl) return true;
  const info = gl.getExtension("WEBGL_debug_renderer_info");
  const name = info ? String(gl.getParameter(info.UNMASKED_RENDERER_WEBGL)) : "";
  gl.getExtension("WEBGL_lose_context")?.loseContext();
  return /swiftshader|llvmpipe|software|basic render/i.test(name);
}
